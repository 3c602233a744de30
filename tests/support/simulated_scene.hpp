#pragma once

#include "cairn/sim/sensor_view.hpp"
#include "small_world.hpp"

#include <functional>
#include <optional>

namespace cairn::test {

/// The room of small_world.hpp, changed, and a robot that stands at (1, 1) and looks along x for ten seconds.
class SimulatedScene {
 public:
  explicit SimulatedScene(const std::function<void(WorldOptions&)>& change) {
    WorldOptions options = small_world_options();
    change(options);
    world_.emplace(make_world(options));
    walls_.emplace(world_->solid, kAllMaterials);
    truth_ = {{Time{}, world_->start}, {time_from_seconds(10.0), world_->start}};
    people_.emplace(*world_, truth_, 1);
    drive_.emplace(SimulatedDrive{*world_, *walls_, *people_, truth_, 1, 0});
  }
  SimulatedScene(const SimulatedScene&) = delete;
  SimulatedScene& operator=(const SimulatedScene&) = delete;

  const WorldOptions& options() const { return world_->options; }
  const SimulatedDrive& drive() const { return *drive_; }

  /// The view of measurement `index`, at time zero.
  SensorView view(std::uint64_t index = 0, std::size_t sensor = 0) const {
    return {*drive_, sensor, index, Time{}, Time{}};
  }
  WorldScene scene() const { return view().scene(); }

 private:
  std::optional<World> world_;
  std::optional<WallGrid> walls_;
  Trajectory truth_;
  std::optional<People> people_;
  std::optional<SimulatedDrive> drive_;
};

}  // namespace cairn::test
