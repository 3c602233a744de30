#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/models/search/place_index.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <functional>
#include <vector>

namespace cairn {

struct SelfSimilarityOptions {
  double apart_m = 1.0;                   ///< another pose is one at least this far away ...
  double apart_rad = 0.7853981633974483;  ///< ... or turned by at least this much (45 degrees)
  /// The other pose explains about as well what is seen here if its log-likelihood is at most this much
  /// lower: a factor of 20.
  double margin = 3.0;
  int headings = 12;               ///< looked in per position
  int beams = 60;                  ///< of the expected scans, spread over the field of view
  int most_alternatives = 4;       ///< per position and heading, the best ones
  double farthest_drive_m = 20.0;  ///< how far a robot drives to find out

  /// @throws ConfigurationError for a value that makes no sense
  void validate() const;
};

/// Another pose from which a scanner sees about the same.
struct Alternative {
  Pose2 T_map_sensor;
  double log_ratio = 0.0;  ///< log-likelihood of the expected scan there, less that at its true pose
};

/// What a map looks like from one position.
struct SelfSimilarPlace {
  Pose2 T_map_sensor;                     ///< the position, and the most ambiguous of the headings looked in
  double ambiguous_headings = 0.0;        ///< share of the headings in which there is an alternative
  std::vector<Alternative> alternatives;  ///< of that heading, the best first; empty: the place is unique
  /// Length of the shortest drive, the robot free to turn, after which scans have told apart every
  /// alternative of the heading that has the fewest; 0: turning is enough; infinite: not within
  /// farthest_drive_m.
  double resolved_after_m = 0.0;
};

/// Where a map is ambiguous for a laser scanner: for every position of the index, whether there is another
/// pose from which the expected scan is explained about as well, by the likelihood field and its noise; with
/// which other poses; and how far one must drive to tell them apart.
///
/// Alternatives are found among the neighbours of the place's signature (place_index.hpp) and then climb to
/// the best pose nearby: a pose that is missed here would have to look alike and have a quite different
/// signature. A scan tells what it ends at, not what it passes through, as in the likelihood field.
///
/// @param likelihood noise and beams of the model
/// @param range_m of the scanner: farther walls are not seen
/// @param on_progress told the share done, 0..1, from the caller's thread
/// @throws ConfigurationError for options that make no sense
std::vector<SelfSimilarPlace> find_self_similarity(const OccupancyGrid& map, const PlaceIndex& index,
                                                   const LikelihoodFieldOptions& likelihood, double range_m,
                                                   const SelfSimilarityOptions& options,
                                                   const Executor& executor,
                                                   const std::function<void(double)>& on_progress = {});

}  // namespace cairn
