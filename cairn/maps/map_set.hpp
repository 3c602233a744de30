#pragma once

#include "cairn/maps/occupancy_grid.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

namespace cairn {

/// One place in every representation that somebody asked for: its occupancy grid, a vector map that was read
/// beside it, the distance field that was computed from it. Each is an immutable snapshot, shared by all
/// models that use it. May be used from several threads at once.
class MapSet {
 public:
  MapSet() = default;
  explicit MapSet(std::shared_ptr<const OccupancyGrid> grid) { add(std::move(grid)); }

  /// Gives the set a representation, in place of what it had of that type.
  template <class Map>
  void add(std::shared_ptr<const Map> map) {
    const std::lock_guard lock(mutex_);
    maps_[{typeid(Map), ""}] = std::move(map);
  }

  /// The representation that was given with add(), or nullptr.
  template <class Map>
  std::shared_ptr<const Map> find() const {
    const std::lock_guard lock(mutex_);
    const auto found = maps_.find({typeid(Map), ""});
    return found == maps_.end() ? nullptr : std::static_pointer_cast<const Map>(found->second);
  }

  /// The representation made with these parameters (a text that tells them apart): made when asked for, and
  /// shared as long as somebody holds it.
  template <class Map>
  std::shared_ptr<const Map> derive(const std::string& parameters,
                                    const std::function<std::shared_ptr<const Map>()>& make) const {
    const std::lock_guard lock(mutex_);
    const std::pair<std::type_index, std::string> name(typeid(Map), parameters);
    if (const auto shared = derived_[name].lock()) return std::static_pointer_cast<const Map>(shared);
    std::shared_ptr<const Map> made = make();
    derived_[name] = made;
    return made;
  }

  /// The occupancy grid. @throws ConfigurationError if the set has none
  std::shared_ptr<const OccupancyGrid> grid() const;

 private:
  mutable std::recursive_mutex mutex_;  // a map may be derived from a derived one
  std::map<std::pair<std::type_index, std::string>, std::shared_ptr<const void>> maps_;
  mutable std::map<std::pair<std::type_index, std::string>, std::weak_ptr<const void>> derived_;
};

/// The maps of a run by name. The first one is the main map: the robot's poses are those of its frame, and so
/// must be the frames of all others.
class MapLibrary {
 public:
  explicit MapLibrary(std::shared_ptr<const MapSet> main) : sets_{{"", std::move(main)}} {}
  // A grid alone is a library of one map: not explicit.
  MapLibrary(std::shared_ptr<const OccupancyGrid> grid);  // NOLINT(google-explicit-constructor)
  MapLibrary(const OccupancyGrid& grid);                  // NOLINT(google-explicit-constructor)

  void add(const std::string& name, std::shared_ptr<const MapSet> maps) { sets_[name] = std::move(maps); }

  const MapSet& main() const { return at(""); }
  /// @param name  empty: the main map
  /// @throws ConfigurationError that names the known maps
  const MapSet& at(const std::string& name) const;

 private:
  std::map<std::string, std::shared_ptr<const MapSet>> sets_;
};

}  // namespace cairn
