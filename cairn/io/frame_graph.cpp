#include "cairn/io/frame_graph.hpp"

#include <deque>
#include <utility>

namespace cairn::ros {
namespace {

constexpr double kSamePosition = 1e-3;  // metres
constexpr double kSameRotation = 1e-3;  // radians

bool same(const RigidTransform& a, const RigidTransform& b) {
  return (a.position - b.position).norm() <= kSamePosition &&
         a.rotation.angularDistance(b.rotation) <= kSameRotation;
}

}  // namespace

void FrameGraph::add(const StampedTransform& sample) {
  const std::string& parent = sample.header.frame_id;
  const std::string& child = sample.child_frame_id;
  const RigidTransform& T = *sample.T_parent_child;
  if (parent == child) return;
  const auto [edge, is_new] = edges_[parent].try_emplace(child, Edge{T});
  if (is_new) edges_[child].try_emplace(parent, Edge{inverse(T)});
  if (same(edge->second.T_from_to, T)) return;
  edge->second.constant = false;
  edges_[child][parent].constant = false;
}

std::optional<RigidTransform> FrameGraph::constant_transform(const std::string& target,
                                                             const std::string& source) const {
  std::map<std::string, RigidTransform> T_target{{target, RigidTransform()}};  // of the frames reached
  std::deque<std::string> open{target};
  while (!open.empty() && !T_target.contains(source)) {
    const std::string frame = std::move(open.front());
    open.pop_front();
    const auto links = edges_.find(frame);
    if (links == edges_.end()) continue;
    for (const auto& [next, edge] : links->second) {
      if (!edge.constant || T_target.contains(next)) continue;
      T_target.emplace(next, T_target.at(frame) * edge.T_from_to);
      open.push_back(next);
    }
  }
  const auto found = T_target.find(source);
  return found == T_target.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace cairn::ros
