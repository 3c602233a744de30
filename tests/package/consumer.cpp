#include "cairn/core/pose2.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <cstdio>

int main() {
  const cairn::Pose2 pose = cairn::Pose2{1.0, 1.0, 0.0} * cairn::Pose2{0.0, 1.0, 0.0};
  const cairn::OccupancyGrid grid({.width = 2, .height = 2, .resolution_m = 0.05, .T_map_grid = {}},
                                  {0, 0, 0, 100});
  std::printf("robot at %.2f %.2f, %zu of 4 cells occupied\n", pose.x, pose.y,
              grid.count(cairn::CellState::kOccupied));
}
