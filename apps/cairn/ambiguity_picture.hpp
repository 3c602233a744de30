#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/search/self_similarity.hpp"

#include <string>
#include <vector>

namespace cairn::app {

/// What the picture shows, and how large.
struct AmbiguityView {
  const OccupancyGrid& map;
  const std::vector<SelfSimilarPlace>& places;
  double spacing_m = 0.5;
  double farthest_drive_m = 20.0;
};

/// Self-contained SVG: the map in grey, each ambiguous place as a square coloured by how far a robot must
/// drive to tell it from its best alternative, both named in its tooltip.
std::string ambiguity_svg(const AmbiguityView& view);

/// Self-contained page: a heading, lines of text, the picture.
std::string ambiguity_page(const AmbiguityView& view, const std::string& title,
                           const std::vector<std::string>& lines);

}  // namespace cairn::app
