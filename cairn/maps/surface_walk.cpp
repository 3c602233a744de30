#include "cairn/maps/surface_walk.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t next(std::size_t corner) { return (corner + 1) % 3; }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// How the weights of the corners change by walking the whole step: that of corner k grows with the distance
// from the edge opposite.
std::array<double, 3> rates(const TriangleMesh& mesh, std::uint32_t face, const Eigen::Vector2d& step) {
  std::array<double, 3> rate{};
  const double twice_area = cross(mesh.corner(face, 1), mesh.corner(face, 2));  // corner 0 is the origin
  for (std::size_t k = 0; k < 3; ++k) {
    const auto from = static_cast<int>(next(k)), to = static_cast<int>(next(next(k)));
    rate[k] = cross(mesh.corner(face, to) - mesh.corner(face, from), step) / twice_area;
  }
  return rate;
}

struct Exit {
  double share;   ///< of the step until there
  int edge = -1;  ///< -1: the step ends within the face
};

Exit find_exit(const std::array<double, 3>& weights, const std::array<double, 3>& rate, double left,
               int entered_by) {
  Exit exit{left};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (k == entered_by || rate[i] >= 0.0) continue;
    const double share = -weights[i] / rate[i];
    if (share < exit.share) exit = {std::max(0.0, share), k};
  }
  return exit;
}

// Rounding must not push a point off its face.
void advance(std::array<double, 3>& weights, const std::array<double, 3>& rate, const Exit& exit) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = static_cast<int>(k) == exit.edge ? 0.0 : std::max(0.0, weights[k] + exit.share * rate[k]);
    sum += weights[k];
  }
  for (double& w : weights) w /= sum;
}

Eigen::Vector2d edge_direction(const TriangleMesh& mesh, std::uint32_t face, int edge) {
  const auto from = static_cast<int>(next(static_cast<std::size_t>(edge))), to = (edge + 2) % 3;
  return (mesh.corner(face, to) - mesh.corner(face, from)).normalized();
}

/// Where a walk is, and what is left of it.
struct Walker {
  SurfacePoint at;
  Eigen::Vector2d step;  ///< the whole step, in the frame of the face
  double left = 1.0;     ///< share of it
  int entered_by = -1;   ///< the edge that it stands on, walking away from it

  void reflect(const TriangleMesh& mesh, int edge) {
    const Eigen::Vector2d along = edge_direction(mesh, at.face, edge);
    step = (2.0 * along.dot(step) * along - step).eval();
    entered_by = edge;
  }

  // The edge runs the other way around the neighbour: what was along it is against it, what was across it
  // from the inside out is from the outside in.
  void cross_over(const TriangleMesh& mesh, int edge, const TriangleMesh::Neighbour& beyond) {
    const Eigen::Vector2d here = edge_direction(mesh, at.face, edge),
                          there = edge_direction(mesh, beyond.face, beyond.edge);
    const double along = here.dot(step), across = cross(here, step);
    step = -along * there - across * Eigen::Vector2d(-there.y(), there.x());
    const std::size_t from = next(static_cast<std::size_t>(edge)), to = next(from);
    const std::size_t opposite = beyond.edge;
    SurfacePoint moved{beyond.face, {}};
    moved.weights[next(opposite)] = at.weights[to];
    moved.weights[next(next(opposite))] = at.weights[from];
    at = moved;
    entered_by = beyond.edge;
  }
};

}  // namespace

WalkEnd walk(const TriangleMesh& mesh, const SurfacePoint& start, const Eigen::Vector2d& step) {
  Walker walker{start, step};
  for (int crossings = 0; crossings <= kMostCrossings; ++crossings) {
    const std::array<double, 3> rate = rates(mesh, walker.at.face, walker.step);
    const Exit exit = find_exit(walker.at.weights, rate, walker.left, walker.entered_by);
    advance(walker.at.weights, rate, exit);
    walker.left -= exit.share;
    if (exit.edge < 0) break;
    if (const auto beyond = mesh.across(walker.at.face, exit.edge)) {
      walker.cross_over(mesh, exit.edge, *beyond);
    } else {
      walker.reflect(mesh, exit.edge);
    }
  }
  return {walker.at, walker.step};
}

}  // namespace cairn
