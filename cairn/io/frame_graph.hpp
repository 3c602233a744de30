#pragma once

#include "cairn/io/ros_messages.hpp"

#include <map>
#include <optional>
#include <string>

namespace cairn::ros {

/// The coordinate frames of a recording and how they are mounted on each other: what tf said, and whether it
/// always said the same. Moving transforms (odom -> base, a panning laser) join nothing here.
class FrameGraph {
 public:
  /// Takes one sample of T_parent_child, which must have its transform. A frame seen from itself is ignored.
  void add(const StampedTransform& sample);

  bool contains(const std::string& frame) const { return edges_.contains(frame); }

  /// T_target_source through constant transforms, over any number of links in either direction; nullopt if no
  /// such path is known. Constant: all samples within 1 mm and 1 mrad of the first.
  std::optional<RigidTransform> constant_transform(const std::string& target,
                                                   const std::string& source) const;

 private:
  struct Edge {
    RigidTransform T_from_to;
    bool constant = true;
  };

  std::map<std::string, std::map<std::string, Edge>> edges_;  // from -> to, each link in both directions
};

}  // namespace cairn::ros
