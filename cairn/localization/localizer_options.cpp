#include "cairn/localization/localizer_options.hpp"

#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/recipes.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

namespace cairn {
namespace {

// Refuses a value outside the range that visit() gives for it: options may come from a program as well as
// from a file.
class RangeCheck final : public OptionVisitor {
 public:
  void number(const Field& field, double& value, Range range) override { check(field, value, range); }
  void integer(const Field& field, int& value, Range range) override { check(field, value, range); }
  void flag(const Field&, bool&) override {}
  void choice(const Field& field, std::string& value, const std::vector<std::string>& choices) override {
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    throw ConfigurationError(prefix_ + field.name, "'" + value + "' is not known", "see `cairn config`");
  }
  void text(const Field&, std::string&) override {}
  void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) override {
    within(field.name, [&] { visit(*this); });
  }
  void table(const Field& field, const std::vector<std::string>& present,
             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) override {
    for (const std::string& key : present) {
      within(field.name + "." + key, [&] { visit_entry(key, *this); });
    }
  }

 private:
  template <class Visit>
  void within(const std::string& name, const Visit& visit) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    visit();
    prefix_ = outer;
  }

  void check(const Field& field, double value, Range range) const {
    if (value >= range.min && value <= range.max) return;  // false for NaN
    std::ostringstream remedy;
    remedy << "give a value from " << range.min << " to " << range.max;
    throw ConfigurationError(prefix_ + field.name, "is out of range", remedy.str());
  }

  std::string prefix_;
};

}  // namespace

void LaserStreamOptions::visit(OptionVisitor& v) {
  const Range anywhere{-1e4, 1e4};
  v.flag({"use", "weigh the belief with this stream"}, use);
  v.flag({"mount_from_log", "take the mounting pose from the log where it tells one"}, mount_from_log);
  v.number({"mount_x_m", "position of the scanner ahead of the robot's base, metres"}, T_base_sensor.x,
           anywhere);
  v.number({"mount_y_m", "position of the scanner to the left of the robot's base, metres"}, T_base_sensor.y,
           anywhere);
  v.number({"mount_yaw_rad", "heading of the scanner on the robot, radians"}, T_base_sensor.theta,
           {-7.0, 7.0});
  v.number({"min_range_m", "shorter ranges are not used, metres", {"laser_min_range"}}, limits.min_range_m,
           {0.0, 1e9});
  v.number({"max_range_m", "longer ranges are not used, metres", {"laser_max_range"}}, limits.max_range_m,
           {0.0, 1e9});
  std::vector<std::string> models = laser_model_names();
  models.insert(models.begin(), "");
  v.choice({"model", "sensor model of this stream; empty: laser.model"}, model, models);
  v.text({"map", "map of this stream, a file in the frame of the main map; empty: the main map"}, map);
  v.number({"effective_beams",
            "in place of laser.effective_beams, lower for a sensor that the map fits less well; 0: that"},
           effective_beams, {0.0, 100000});
  v.number({"stamp_offset_s",
            "added to the stamps, seconds; negative for a sensor that stamps its data when it sends them"},
           stamp_offset_s, {-10.0, 10.0});
  v.number({"nice", "scheduler.policy cfs: a stream with a lower value is used more often"}, nice,
           {1e-3, 1e3});
  v.number({"rate_hz", "in place of scheduler.rate_hz; 0: that one"}, rate_hz, {0.0, 1e6});
  v.number({"cost", "modelled cost of one beam, relative to scheduler.cost_ns"}, cost, {0.0, 1e6});
  v.number({"period_s", "time between two messages, for the watchdog; 0: measured"}, period_s, {0.0, 1e6});
}

void FilterOptions::visit(OptionVisitor& v) {
  const Range count{1, 10'000'000};
  v.integer({"particles", "number of particles of the recipe mcl"}, particles, count);
  v.integer({"min_particles", "fewest particles of the recipe kld_mcl"}, min_particles, count);
  v.integer({"max_particles", "most particles of the recipe kld_mcl"}, max_particles, count);
  v.section({"kld", "KLD-sampling: how the number of particles follows the spread of the belief"},
            [this](OptionVisitor& inner) { kld.visit(inner); });
  v.choice({"resampling", "scheme that draws the ancestors of the next particles"}, resampling,
           resampling_schemes());
  v.section({"resample", "when the particles are resampled"},
            [this](OptionVisitor& inner) { resample.visit(inner); });
  v.number({"min_ess_share",
            "a scan enters in portions that leave at least this effective share of the particles"},
           min_ess_share, {0.0, 0.9});
  v.section({"kernel", "small moves of the particles between the portions"},
            [this](OptionVisitor& inner) { kernel.visit(inner); });
  v.section({"clusters", "recipes csrl, ckld_srl and ckld_mcl: groups of particles that are kept apart"},
            [this](OptionVisitor& inner) { clusters.visit(inner); });
  v.number({"cluster_memory",
            "recipes ckld_srl and ckld_mcl: share of a group's log-weight that outlives a measurement; 0: "
            "the paper, 1: exact Bayes"},
           cluster_memory, {0.0, 1.0});
  v.section({"resetting", "recipes srl and csrl: new particles when the measurements do not fit"},
            [this](OptionVisitor& inner) { resetting.visit(inner); });
  v.section({"augmented", "recipe amcl: new particles when the measurements fit worse than usual"},
            [this](OptionVisitor& inner) { augmented.visit(inner); });
  v.number({"source_per_m2", "poses that new particles are chosen from, per square metre of free space"},
           source_per_m2, {0.01, 1e5});
}

void FilterOptions::validate() const {
  augmented.validate();
  if (min_particles > max_particles) {
    throw ConfigurationError("filter.min_particles", "is larger than filter.max_particles",
                             "lower it or raise max_particles");
  }
}

TriggerOptions UpdateOptions::trigger() const {
  TriggerOptions trigger;
  trigger.when = when;
  trigger.min_translation_m = min_translation_m;
  trigger.min_rotation_rad = min_rotation_rad;
  trigger.every_n = every_n;
  trigger.rate_hz = rate_hz;
  return trigger;
}

void UpdateOptions::visit(OptionVisitor& v) {
  v.choice({"when", "what makes a scan worth an update: motion, updates (every n-th) or rate"}, when,
           {"motion", "updates", "rate"});
  v.number({"min_translation_m", "a scan is used after this much driving, metres", {"update_min_d"}},
           min_translation_m, {0.0, 100.0});
  v.number({"min_rotation_rad", "or after this much turning, radians", {"update_min_a"}}, min_rotation_rad,
           {0.0, 7.0});
  v.integer({"every_n", "updates: every n-th scan of a stream is used"}, every_n, {1, 1'000'000});
  v.number({"rate_hz", "rate: one scan of a stream is used per period, hertz"}, rate_hz, {1e-3, 1e4});
}

void InitialOptions::visit(OptionVisitor& v) {
  v.number({"sigma_x_m", "spread of the belief around a given start pose, standard deviation, metres"},
           sigma_x_m, {0.0, 1e3});
  v.number({"sigma_y_m", "likewise, metres"}, sigma_y_m, {0.0, 1e3});
  v.number({"sigma_yaw_rad", "likewise, radians"}, sigma_yaw_rad, {0.0, 7.0});
}

void GlobalOptions::visit(OptionVisitor& v) {
  v.number({"sigma_hit_m", "as laser.sigma_hit_m, while the belief is spread over several places, metres"},
           sigma_hit_m, {1e-3, 10.0});
  v.number({"effective_beams", "as laser.effective_beams, likewise"}, effective_beams, {0.1, 100000});
  v.number({"candidates_per_m2", "poses that the first scan chooses from, per square metre of free space"},
           candidates_per_m2, {0.1, 1e5});
  v.integer({"most_poses", "distinct places that a search over the whole map keeps; 0: no search"},
            most_poses, {0, 10000});
  v.number({"search_sigma_m", "as laser.sigma_hit_m, in that search, metres"}, search_sigma_m, {1e-3, 10.0});
  v.number({"search_millions", "a search looks up at most this many million end points"}, search_millions,
           {0.01, 1e6});
  v.integer({"search_looks", "scans of the way that are remembered until the pose is confirmed"},
            search_looks, {8, 10000});
  v.number({"look_spacing_m", "they are this far apart, metres"}, look_spacing_m, {0.0, 100.0});
  v.number({"look_spacing_rad", "or turned by this, radians"}, look_spacing_rad, {0.0, 7.0});
  v.integer({"search_every", "new ones until the search is repeated"}, search_every, {1, 10000});
  v.number({"look_beams", "as which each of them counts, in independent beams"}, look_beams, {0.01, 100000});
  v.number({"most_million_cells", "no search on a larger map: it needs about 60 bytes per cell"},
           most_million_cells, {0.0, 1e4});
}

void CgrOptions::visit(OptionVisitor& v) {
  v.integer({"particles", "number of particles of the recipe cgr"}, particles, {1, 2000});
  refinement.visit(v);
}

void LocalizerOptions::visit(OptionVisitor& v) {
  const auto section = [&v](const std::string& name, const std::string& documentation, auto& options) {
    v.section({name, documentation}, [&options](OptionVisitor& inner) { options.visit(inner); });
  };
  v.choice(
      {"recipe",
       "composition of the filter: mcl (fixed number of particles), kld_mcl (adaptive), amcl (and recovers), "
       "cgr (few, refined by the measurement); "
       "srl, kld_srl (sensor resetting); csrl, ckld_srl, ckld_mcl (and keep hypotheses apart)"},
      recipe, recipe_names());
  v.text({"odometry_stream",
          "name of the odometry in the log; empty: the first odometry stream; none: do without"},
         odometry_stream);
  section("motion", "odometry motion model of a differential drive", motion);
  section("random_walk", "how the robot strays while there is no odometry", random_walk);
  section("laser", "sensor models of the laser scanners", laser);
  section("filter", "particles", filter);
  section("update", "when a scan is worth an update", update);
  section("initial", "spread around a given start pose", initial);
  section("global", "while the belief is spread over several places", global);
  section("time", "data that comes late, or not at all", time);
  section("scheduler", "which measurements get the computing time", scheduler);
  section("cgr", "recipe cgr: refinement of the particles along the gradient of the measurement", cgr);
  section("monitor", "how the localizer judges itself, log-odds per figure of a scan", monitor);
  section("recovery", "global localization of a robot that is lost", recovery);
  std::vector<std::string> present;
  for (const auto& [name, unused] : streams) present.push_back(name);
  v.table({"streams", "laser streams by their name in the log; none: every laser stream is used"}, present,
          [this](const std::string& key, OptionVisitor& inner) { streams[key].visit(inner); });
}

void LocalizerOptions::validate() const {
  RangeCheck ranges;
  LocalizerOptions(*this).visit(ranges);
  filter.validate();
  laser.validate();
  for (const auto& [name, stream] : streams) {
    if (stream.limits.min_range_m >= stream.limits.max_range_m) {
      throw ConfigurationError("streams." + name + ".min_range_m", "is not below max_range_m",
                               "make it smaller than max_range_m");
    }
  }
}

}  // namespace cairn
