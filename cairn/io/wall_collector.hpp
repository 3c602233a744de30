#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/maps/vector_map.hpp"

#include <string>
#include <vector>

namespace cairn {

/// Gathers the walls that a reader finds, and refuses what is none.
class WallCollector {
 public:
  /// @param name  of the file
  WallCollector(std::string name, Diagnostics& diagnostics)
      : name_(std::move(name)), diagnostics_(diagnostics) {}

  /// A wall without length is left out and counted ("zero-length segment").
  /// @param where  for the message
  /// @throws InputError for a coordinate that is not finite or out of range, and for too many walls
  void add(const Wall& wall, const std::string& where);

  bool empty() const { return walls_.empty(); }
  /// The map. @throws InputError if there is no wall
  VectorMap finish();

 private:
  std::string name_;
  Diagnostics& diagnostics_;
  std::vector<Wall> walls_;
};

}  // namespace cairn
