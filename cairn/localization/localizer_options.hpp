#pragma once

#include "cairn/bayes/gradient_refinement.hpp"
#include "cairn/bayes/hypotheses.hpp"
#include "cairn/bayes/injections/injections.hpp"
#include "cairn/bayes/kld.hpp"
#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/bayes/triggers/triggers.hpp"
#include "cairn/core/options.hpp"
#include "cairn/localization/monitor.hpp"
#include "cairn/localization/recovery.hpp"
#include "cairn/localization/scheduler.hpp"
#include "cairn/localization/time_options.hpp"
#include "cairn/models/motion/differential_drive.hpp"
#include "cairn/models/motion/random_walk.hpp"
#include "cairn/models/registry.hpp"
#include "cairn/models/sensor/beam_selection.hpp"

#include <map>
#include <string>

namespace cairn {

/// How a laser stream of the log is used.
struct LaserStreamOptions {
  bool use = true;
  bool mount_from_log = true;  ///< take the mounting pose from the log where it tells one
  Pose2 T_base_sensor;         ///< used where the log does not tell, or if mount_from_log is false
  BeamLimits limits;
  std::string model;  ///< sensor model, by its name in cairn/models/registry.hpp; empty: laser.model
  std::string map;    ///< name in the MapLibrary; empty: the main map
  double effective_beams = 0.0;  ///< in place of laser.effective_beams; 0: that
  double stamp_offset_s = 0.0;   ///< added to the stamps: the sensor saw it then, in the odometry's clock
  double nice = 1.0;      ///< virtual time per time of computing: a lower one is used more often (Scheduler)
  double rate_hz = 0.0;   ///< in place of scheduler.rate_hz; 0: that one
  double cost = 1.0;      ///< modelled cost of one beam, relative to scheduler.cost_ns
  double period_s = 0.0;  ///< time between two messages, for the watchdog; 0: measured

  void visit(OptionVisitor& visitor);
};

struct FilterOptions {
  int particles = 2000;     ///< recipe mcl
  int min_particles = 500;  ///< recipe kld_mcl
  int max_particles = 10000;
  KldOptions kld;
  std::string resampling = "systematic";
  TriggerOptions resample;  ///< when; recipe kld_mcl reads `ess` as: before every prediction
  double min_ess_share = 0.15;
  PoseKernelOptions kernel;
  HypothesisOptions clusters;        ///< recipes csrl, ckld_srl and ckld_mcl
  double cluster_memory = 0.8;       ///< recipes ckld_srl and ckld_mcl: see TwoStage
  SensorResettingOptions resetting;  ///< recipes srl and csrl
  AugmentedOptions augmented;        ///< recipe amcl
  double source_per_m2 = 20.0;  ///< poses that samples of p(x | z) are chosen from, per m^2 of free space

  void visit(OptionVisitor& visitor);
  void validate() const;  ///< @throws ConfigurationError
};

/// When a scan is worth an update: after either motion since the last one of its stream, unless told
/// otherwise.
struct UpdateOptions {
  double min_translation_m = 0.1;
  double min_rotation_rad = 0.1;
  std::string when = "motion";  ///< motion, updates (every n-th scan of a stream) or rate
  int every_n = 1;
  double rate_hz = 5.0;

  TriggerOptions trigger() const;
  void visit(OptionVisitor& visitor);
};

/// Spread of the belief around a start pose that the user gives, standard deviations.
struct InitialOptions {
  double sigma_x_m = 0.3;
  double sigma_y_m = 0.3;
  double sigma_yaw_rad = 0.15;

  void visit(OptionVisitor& visitor);
};

/// How scans are read while the belief is spread over several places. There are then fewer particles than
/// places, so that none stands exactly where the robot is: the likelihood must be as wide as the gaps between
/// them.
struct GlobalOptions {
  double sigma_hit_m = 0.4;
  double effective_beams = 6.0;
  double candidates_per_m2 =
      250.0;  ///< poses that the first scan of a robot that may be anywhere chooses from
  /// Distinct places that a search over the whole map keeps (global_search.hpp); 0: no search. Half of the
  /// first particles stand at those of the first scan, the others are chosen from the candidates.
  int most_poses = 40;
  double search_sigma_m = 0.2;  ///< sigma_hit of the search: joined by odometry, the points are out of place
  double search_millions = 10.0;  ///< a search looks up at most this many million end points
  int search_looks = 40;          ///< measurements of the way that are remembered
  double look_spacing_m = 0.5;    ///< this far apart ...
  double look_spacing_rad = 0.5;  ///< ... or turned by this
  int search_every = 4;           ///< new ones until the search is repeated, while the pose is not confirmed
  double look_beams = 2.0;        ///< as which each of them counts, in independent beams
  /// A search takes about 60 bytes per cell: there is none on a larger map, and a warning says so.
  double most_million_cells = 16.0;

  void visit(OptionVisitor& visitor);
};

/// The recipe cgr: few particles, refined by the measurement. The densities of the acceptance test cost the
/// square of their number.
struct CgrOptions {
  int particles = 20;
  GradientRefinementOptions refinement;

  void visit(OptionVisitor& visitor);
};

/// Everything about a localizer but its map, its start and its seed.
struct LocalizerOptions {
  std::string recipe = "kld_mcl";
  std::string odometry_stream;  ///< name in the log; empty: the only one, or the first; none: do without
  DifferentialDriveOptions motion;
  RandomWalkOptions random_walk;  ///< while there is no odometry
  LaserModelOptions laser;
  FilterOptions filter;
  UpdateOptions update;
  InitialOptions initial;
  GlobalOptions global;
  TimeOptions time;
  SchedulerOptions scheduler;
  CgrOptions cgr;
  MonitorOptions monitor;
  RecoveryOptions recovery;
  std::map<std::string, LaserStreamOptions>
      streams;  ///< by name in the log; none: every laser stream is used

  void visit(OptionVisitor& visitor);
  /// @throws ConfigurationError for a value out of the range that visit() gives, and for values that do not
  /// fit
  ///   each other
  void validate() const;
};

}  // namespace cairn
