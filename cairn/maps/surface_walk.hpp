#pragma once

#include "cairn/maps/triangle_mesh.hpp"

namespace cairn {

/// Where a walk ends.
struct WalkEnd {
  SurfacePoint point;
  Eigen::Vector2d step;  ///< the whole step as it points at the end, in the frame of that face
};

/// Walks straight ahead on a surface: over an edge as if the neighbouring face were folded into the plane of
/// the one before (Polthier & Schmies, "Straightest geodesics on polyhedral surfaces", 1998). At the border
/// of an open mesh the way is reflected.
///
/// A walk keeps its length, and `walk(mesh, end.point, -end.step)` leads back. A start uniform over the area
/// with a direction uniform over the circle ends uniform over the area.
/// @param step in the frame of the start's face (see TriangleMesh), metres
/// @return the end. A walk that would cross more than kMostCrossings edges ends there: one that runs into a
///   corner to within rounding may.
WalkEnd walk(const TriangleMesh& mesh, const SurfacePoint& start, const Eigen::Vector2d& step);

constexpr int kMostCrossings = 100'000;

}  // namespace cairn
