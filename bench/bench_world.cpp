#include "bench_world.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>

namespace cairn::bench {
namespace {

constexpr int kCells = 1000;
constexpr double kResolution = 0.05;
constexpr int kRoomCells = 200;
constexpr int kBeams = 60;
constexpr double kMaxRange = 30.0;

// Walls of two cells around every room, doors of 1 m in the middle of each wall.
bool is_wall(int column, int row, int cells) {
  const int x = column % kRoomCells, y = row % kRoomCells;
  const bool outer = column < 2 || row < 2 || column >= cells - 2 || row >= cells - 2;
  const bool in_door = std::abs(x - kRoomCells / 2) < 10 || std::abs(y - kRoomCells / 2) < 10;
  return outer || ((x < 2 || y < 2) && !in_door);
}

float measure(const OccupancyGrid& map, const Pose2& T_map_beam) {
  constexpr double kStep = kResolution / 5.0;
  double range = 0.0;
  while (range < kMaxRange && map.state_at(T_map_beam * Point2{range, 0.0}) == CellState::kFree)
    range += kStep;
  return static_cast<float>(range);
}

BenchWorld make_world() {
  BenchWorld world{square_map(kCells), {23.1, 26.4, 0.3}, {}};
  LaserScan& scan = world.scan;
  scan.angle_increment_rad = kTwoPi / kBeams;
  scan.angle_min_rad = -0.5 * (kBeams - 1) * scan.angle_increment_rad;
  scan.range_min_m = 0.1;
  scan.range_max_m = kMaxRange;
  for (int beam = 0; beam < kBeams; ++beam) {
    const double angle = scan.angle_min_rad + beam * scan.angle_increment_rad;
    scan.ranges_m.push_back(measure(*world.map, world.T_map_base * Pose2{0.0, 0.0, angle}));
  }
  return world;
}

const RandomStream kRandom(1, RandomPurpose::kTest, 0);

}  // namespace

std::shared_ptr<const OccupancyGrid> square_map(int side) {
  const GridGeometry geometry{side, side, kResolution, {}};
  std::vector<OccupancyGrid::Cell> cells(geometry.size());
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column)
      cells[geometry.index(column, row)] = is_wall(column, row, side) ? 100 : 0;
  }
  return std::make_shared<const OccupancyGrid>(geometry, std::move(cells));
}

const BenchWorld& bench_world() {
  static const BenchWorld world = make_world();
  return world;
}

std::vector<Pose2> tracking_particles(std::size_t count) {
  std::vector<Pose2> particles(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = kRandom.normal4(static_cast<std::uint32_t>(i));
    const Pose2& center = bench_world().T_map_base;
    particles[i] = {center.x + 0.2 * n[0], center.y + 0.2 * n[1], normalize_angle(center.theta + 0.1 * n[2])};
  }
  return particles;
}

std::vector<Pose2> global_particles(std::size_t count) {
  std::vector<Pose2> particles(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = kRandom.uniform4(static_cast<std::uint32_t>(i));
    particles[i] = {kCells * kResolution * u[0], kCells * kResolution * u[1], kPi * (2.0 * u[2] - 1.0)};
  }
  return particles;
}

}  // namespace cairn::bench
