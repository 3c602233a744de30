#pragma once

#include "cairn/core/options.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/models/sensor/beam_model.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/beam_skipping.hpp"
#include "cairn/models/sensor/laser_model.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "cairn/models/sensor/ndt_model.hpp"
#include "cairn/models/sensor/vector_laser.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// The options of every sensor model of laser scans, under the keys of `laser`.
struct LaserModelOptions {
  std::string model = "likelihood_field_prob";  ///< name in the registry, unless a stream names its own
  LikelihoodFieldOptions likelihood_field;      ///< likelihood_field_prob, likelihood_field and v_amcl
  BeamModelOptions beam;
  NdtModelOptions ndt;  ///< ndt and ondt
  VectorLaserOptions vector_laser;
  BeamSkippingOptions beam_skip;  ///< every model, while the belief is compact

  void visit(OptionVisitor& visitor);
  /// @throws ConfigurationError for values that do not fit each other
  void validate() const;
};

/// The same models for a belief that is spread over several places. There are then fewer particles than
/// places, so that none stands exactly where the robot is: the likelihood must be as wide as the gaps between
/// them.
/// @param sigma_hit_m  distance of end points to the mapped wall, standard deviation
LaserModelOptions widened(const LaserModelOptions& narrow, double sigma_hit_m, double effective_beams);

/// The same models, in which a scan counts as so many independent beams.
LaserModelOptions with_effective_beams(LaserModelOptions options, double effective_beams);

/// What a sensor model is made of.
struct LaserModelParts {
  const MapSet& maps;
  Pose2 T_base_sensor;  ///< where the scanner sits on the robot
  BeamLimits limits;
  const LaserModelOptions& options;
};

/// The names in the registry, the default first.
std::vector<std::string> laser_model_names();

/// Makes a sensor model of laser scans by its name; the maps that it needs are derived from those at hand.
/// @throws ConfigurationError for an unknown name, or if the maps at hand do not do
std::shared_ptr<const LaserModel> make_laser_model(const std::string& name, const LaserModelParts& parts);

}  // namespace cairn
