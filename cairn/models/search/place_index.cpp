#include "cairn/models/search/place_index.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/ray_marching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nanoflann.hpp>

namespace cairn {
namespace {

constexpr std::size_t kRaysPerHeading = 5;
constexpr std::size_t kPositionsAtOnce = 64;

/// The squares of a lattice that hold free cells, each with its free cell nearest to the middle.
std::vector<Point2> positions_on(const OccupancyGrid& map, double spacing_m) {
  const GridGeometry& grid = map.geometry();
  const int side = std::max(1, static_cast<int>(std::lround(spacing_m / grid.resolution_m)));
  std::vector<Point2> positions;
  for (int row = 0; row < grid.height; row += side) {
    for (int column = 0; column < grid.width; column += side) {
      double least = std::numeric_limits<double>::infinity();
      Point2 best{};
      for (int r = row; r < std::min(row + side, grid.height); ++r) {
        for (int c = column; c < std::min(column + side, grid.width); ++c) {
          if (map.state(grid.index(c, r)) != CellState::kFree) continue;
          const double off = std::hypot(c - column - 0.5 * (side - 1), r - row - 0.5 * (side - 1));
          if (off < least) least = off, best = grid.center(c, r);
        }
      }
      if (std::isfinite(least)) positions.push_back(best);
    }
  }
  return positions;
}

double spacing_for(const OccupancyGrid& map, const PlaceIndexOptions& options) {
  const double cell = map.geometry().resolution_m;
  const double most_positions = std::max(1.0, static_cast<double>(options.most_places) / options.headings);
  const double area_m2 = static_cast<double>(map.count(CellState::kFree)) * cell * cell;
  return std::max({options.spacing_m, cell, std::sqrt(area_m2 / most_positions)});
}

void check(const OccupancyGrid& map, const PlaceIndexOptions& options) {
  if (map.count(CellState::kFree) == 0)
    throw ConfigurationError("map", "has no free cell", "check its thresholds");
  if (!(options.spacing_m > 0.0) || options.headings < 1 || options.most_places < options.headings)
    throw ConfigurationError("place index", "has no places",
                             "give a positive spacing, headings and number of places");
}

}  // namespace

/// The signatures as nanoflann wants to see them.
struct PlaceIndex::Tree {
  struct Points {
    const std::vector<ScanSignature>& signatures;
    std::size_t kdtree_get_point_count() const { return signatures.size(); }
    float kdtree_get_pt(std::size_t point, std::size_t dimension) const {
      return signatures[point][dimension];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points,
                                          static_cast<int>(SignatureShape::kSectors), std::uint32_t>;

  explicit Tree(const std::vector<ScanSignature>& signatures)
      : points{signatures},
        index(static_cast<int>(SignatureShape::kSectors), points,
              nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    index.buildIndex();
  }
  Points points;
  Index index;
};

PlaceIndex::PlaceIndex(const OccupancyGrid& map, const SignatureShape& shape,
                       const PlaceIndexOptions& options, const std::function<void(double)>& on_progress)
    : shape_(shape), spacing_m_(spacing_for(map, options)), headings_(options.headings) {
  shape.validate();
  check(map, options);
  positions_ = positions_on(map, spacing_m_);
  simulate(map, on_progress);
  plant();
}

PlaceIndex::PlaceIndex(const OccupancyGrid& map, const SignatureShape& shape,
                       const PlaceIndexOptions& options, std::vector<ScanSignature> signatures)
    : shape_(shape),
      spacing_m_(spacing_for(map, options)),
      headings_(options.headings),
      signatures_(std::move(signatures)) {
  shape.validate();
  check(map, options);
  positions_ = positions_on(map, spacing_m_);
  CAIRN_ASSERT(signatures_.size() == positions_.size() * static_cast<std::size_t>(headings_));
  plant();
}

PlaceIndex::~PlaceIndex() = default;

// The rays all around a position serve all its headings.
void PlaceIndex::simulate(const OccupancyGrid& map, const std::function<void(double)>& on_progress) {
  const RayMarcher rays(map, shape_.max_range_m);
  const std::size_t count = kRaysPerHeading * static_cast<std::size_t>(headings_);
  std::vector<double> bearings(count);
  for (std::size_t k = 0; k < count; ++k)
    bearings[k] = kTwoPi * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
  signatures_.reserve(positions_.size() * static_cast<std::size_t>(headings_));
  std::vector<Pose2> poses;
  std::vector<float> ranges;
  std::vector<float> turned(count);
  for (std::size_t first = 0; first < positions_.size(); first += kPositionsAtOnce) {
    poses.clear();
    for (std::size_t i = first; i < std::min(first + kPositionsAtOnce, positions_.size()); ++i)
      poses.push_back({positions_[i].x, positions_[i].y, 0.0});
    ranges.resize(poses.size() * count);
    rays.cast(poses, bearings, ranges);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      for (std::size_t h = 0; h < static_cast<std::size_t>(headings_); ++h) {
        const auto own = ranges.begin() + static_cast<std::ptrdiff_t>(i * count);
        std::rotate_copy(own, own + static_cast<std::ptrdiff_t>(h * kRaysPerHeading),
                         own + static_cast<std::ptrdiff_t>(count), turned.begin());
        signatures_.push_back(signature_of(bearings, turned, shape_));
      }
    }
    if (on_progress) on_progress(static_cast<double>(first) / static_cast<double>(positions_.size()));
  }
}

void PlaceIndex::plant() { tree_ = std::make_unique<const Tree>(signatures_); }

double PlaceIndex::heading_step_rad() const { return kTwoPi / headings_; }

PlaceIndex::Place PlaceIndex::place(std::size_t index) const {
  const auto headings = static_cast<std::size_t>(headings_);
  const Point2& p = positions_[index / headings];
  return {{p.x, p.y, normalize_angle(heading_step_rad() * static_cast<double>(index % headings))}};
}

std::vector<PlaceIndex::Neighbour> PlaceIndex::nearest(const ScanSignature& signature,
                                                       std::size_t count) const {
  count = std::min(count, size());
  std::vector<std::uint32_t> found(count);
  std::vector<float> squared(count);
  count = tree_->index.knnSearch(signature.data(), count, found.data(), squared.data());
  std::vector<Neighbour> neighbours;
  neighbours.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    neighbours.push_back({found[i], std::sqrt(squared[i] / static_cast<float>(SignatureShape::kSectors))});
  return neighbours;
}

Pose2 PlaceIndex::sample(std::size_t index, const RandomStream& random, std::uint32_t item) const {
  const auto u = random.uniform4(item, 2);
  const Pose2 middle = place(index).T_map_sensor;
  return {middle.x + spacing_m_ * (u[0] - 0.5), middle.y + spacing_m_ * (u[1] - 0.5),
          normalize_angle(middle.theta + heading_step_rad() * (u[2] - 0.5))};
}

std::size_t PlaceIndex::places_on(const OccupancyGrid& map, const PlaceIndexOptions& options) {
  return positions_on(map, spacing_for(map, options)).size() * static_cast<std::size_t>(options.headings);
}

}  // namespace cairn
