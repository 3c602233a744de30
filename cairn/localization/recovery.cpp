#include "cairn/localization/recovery.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kDoubtfulScans = 3;       // for which one scan raises doubt
constexpr double kSearchAgain_s = 0.5;  // where one scan after the other does not go on
constexpr double kHardlyRight = 0.1;    // probability at which a pose is doubted, however it was reached
constexpr double kSettled = 0.99;       // share of the believed place at which no other counts any more
constexpr double kBestOfFew = 0.3;      // probability of one of two or three places that fit alike
// Spread of a rival that takes over.
constexpr double kSpread_m = 0.1, kSpread_rad = 0.05;

// One radian counts as one metre.
double way(const Pose2& T) { return std::hypot(T.x, T.y) + std::abs(normalize_angle(T.theta)); }

bool is_near(const Pose2& T, double within_m, double within_rad) {
  return std::hypot(T.x, T.y) < within_m && std::abs(normalize_angle(T.theta)) < within_rad;
}

// How much better the remembered scans fit at the found places than where the robot is believed, nat.
std::vector<double> gains_of(const std::vector<LocatedPose>& found, const std::vector<Glimpse>& glimpses,
                             const StreamModel& model, const Pose2& believed, const Rivals& rivals,
                             const RecoveryOptions& options) {
  std::vector<double> gains(found.size());
  std::vector<Pose2> places(found.size() + 1);
  std::vector<double> fits(places.size());
  const Glimpse* before = nullptr;
  for (const Glimpse& glimpse : glimpses) {
    const double moved_m = before ? way(inverse(before->T_now_then) * glimpse.T_now_then) : options.news_m;
    const double news = std::min(1.0, moved_m / options.news_m);
    before = &glimpse;
    places[0] = believed * glimpse.T_now_then;
    for (std::size_t i = 0; i < found.size(); ++i) places[i + 1] = found[i].T_map_base * glimpse.T_now_then;
    if (!model.follow(glimpse.z, places, fits)) return gains;
    for (std::size_t i = 0; i < found.size(); ++i)
      gains[i] += news * (rivals.evidence(fits[i + 1]) - rivals.evidence(fits[0]));
  }
  return gains;
}

}  // namespace

void RecoveryOptions::visit(OptionVisitor& v) {
  v.flag({"active", "look for a robot that is lost (recipes mcl, kld_mcl, cgr and ckld_mcl)"}, active);
  v.number({"doubt", "in doubt while the pose is right with less than this probability"}, doubt, {0.0, 1.0});
  v.number({"drop", "and where the map explains by this share fewer beams than usual"}, drop, {0.0, 1.0});
  v.number({"surprise", "a scan that it explains by this less than the last is worth an update; 0: never"},
           surprise, {0.0, 1.0});
  v.number({"prior", "probability of being elsewhere when doubt begins, shared by what is found"}, prior,
           {1e-9, 0.999});
  v.number({"news_m", "way after which a scan is news, metres"}, news_m, {1e-3, 100.0});
  v.number({"every_s", "time between two searches, doubled after each that finds nothing, seconds"}, every_s,
           {0.0, 1e6});
  v.number({"at_most_every_s", "up to this, seconds"}, at_most_every_s, {0.0, 1e6});
  v.integer({"scans", "of the last ones that may be joined"}, scans, {1, 100});
  v.number({"spacing_m", "joined scans are this far apart, metres"}, spacing_m, {0.0, 100.0});
  v.number({"spacing_rad", "or turned by this, radians"}, spacing_rad, {0.0, 7.0});
  v.integer({"most_poses", "distinct places that a search finds"}, most_poses, {1, 10000});
  v.number({"sigma_hit_m", "as laser.sigma_hit_m, in the search, metres"}, sigma_hit_m, {1e-3, 10.0});
  v.number({"effective_beams", "as laser.effective_beams, for the first of the joined scans"},
           effective_beams, {0.1, 100000});
  v.number({"further_beams", "likewise for each of the others"}, further_beams, {0.0, 100000});
  v.number({"crowd_m",
            "where most beams end nearer, a search looks also at what lies farther only, metres; 0: never"},
           crowd_m, {0.0, 1e3});
  v.number({"millions_of_points", "a search looks up at most this many million end points"},
           millions_of_points, {0.01, 1e6});
  v.number({"rival_beams", "as laser.effective_beams, for a scan that rivals are weighed by"}, rival_beams,
           {0.01, 1e5});
  v.number({"rival_most", "a scan never speaks more than this against a place, nat"}, rival_most, {0.0, 1e3});
  v.number({"accept", "log-odds at which a rival takes over"}, accept, {0.0, 1e3});
  v.number({"sure", "and so much more while the pose is right with at least the probability `doubt`"}, sure,
           {0.0, 1e3});
  v.integer({"confirm", "after so many scans that have weighed it since it was found"}, confirm, {0, 1000});
  v.number({"share", "with this probability among all places"}, share, {0.0, 1.0});
  v.number({"refuted", "where this share of the beams ends behind walls or off the map"}, refuted,
           {0.0, 2.0});
  v.number({"refuted_accept", "these log-odds"}, refuted_accept, {0.0, 1e3});
  v.number({"refuted_share", "and this probability are enough"}, refuted_share, {0.0, 1.0});
  v.number({"hopeless", "or with these log-odds, if it is one of two or three"}, hopeless, {0.0, 1e3});
  v.number({"continued", "less than this share of a scan goes on from the last one: carried away; 0: never"},
           continued, {0.0, 1.0});
  v.number({"carried", "prior of being elsewhere then, shared by what is found"}, carried, {1e-9, 0.999});
  v.number({"anchor_m", "after so much way without such a scan places elsewhere are given up, metres"},
           anchor_m, {0.0, 1e6});
  v.number({"settle_m", "after so much where another place has taken over, metres"}, settle_m, {0.0, 1e6});
  v.number({"most_million_cells", "no recovery on a larger map: a search needs about 60 bytes per cell"},
           most_million_cells, {0.0, 1e4});
}

bool Recovery::doubtful(double right, double explained, double usual) const {
  return right < options_.doubt || explained < usual - options_.drop;
}

Standing Recovery::standing(double right, const std::optional<BeamShares>& seen) const {
  const bool enough = seen && static_cast<double>(seen->beams) >= options_.rival_beams;
  if (enough && seen->beyond + seen->unknown >= options_.refuted) return Standing::kRefuted;
  return right >= options_.doubt ? Standing::kTrusted : Standing::kDoubtful;
}

bool Recovery::surprising(double explained_before, double explained_now) const {
  return options_.surprise > 0.0 && explained_now < explained_before - options_.surprise;
}

Link Recovery::link(const std::optional<double>& continued) const {
  if (!continued || options_.continued <= 0.0) return Link::kUnknown;
  return *continued < options_.continued ? Link::kBroken : Link::kHolds;
}

RecoveryMemory Recovery::begin(bool anywhere) const {
  RecoveryMemory memory;
  if (!anywhere && options_.continued > 0.0) memory.proven_m = options_.anchor_m;
  return memory;
}

void Recovery::note(RecoveryMemory& memory, Link link, Time now) const {
  if (link == Link::kHolds || (link == Link::kUnknown && memory.carried)) return;
  memory.proven_m = 0.0;
  if (link == Link::kUnknown) return;
  if (!memory.carried) {
    memory.rivals.clear();
    memory.settled_at_m = options_.anchor_m;
  }
  if (to_seconds(now - memory.searched_at) > kSearchAgain_s) memory.searched = false;
  memory.carried = true;
  memory.wait_s = 0.0;
  memory.glimpses.clear();
}

bool Recovery::anchored(const RecoveryMemory& memory) const {
  return !memory.carried && memory.proven_m >= options_.anchor_m;
}

bool Recovery::well_tracked(const RecoveryMemory& memory) const {
  return !memory.carried && memory.proven_m >= 2.0 * options_.anchor_m;
}

void Recovery::unsettle(RecoveryMemory& memory) {
  memory.proven_m = 0.0;
  memory.carried = false;
}

void Recovery::settle(RecoveryMemory& memory, double right, Standing standing, bool vouched) const {
  const bool disproved =
      right < kHardlyRight || standing == Standing::kRefuted || memory.doubted_m >= options_.anchor_m;
  if (disproved && !vouched) memory.proven_m = 0.0;
  const bool alone = Rivals::believed_share(memory.rivals) >= kSettled;
  if (memory.proven_m < (memory.carried ? memory.settled_at_m : options_.anchor_m) || !alone) return;
  memory.carried = false;
  memory.rivals.clear();
}

void Recovery::carry(RecoveryMemory& memory, const Pose2& T_before_after, double since_s) {
  const Pose2 T_now_before = inverse(T_before_after);
  for (Glimpse& glimpse : memory.glimpses) glimpse.T_now_then = T_now_before * glimpse.T_now_then;
  Rivals::carry(memory.rivals, T_before_after, since_s);
  memory.moved_m += way(T_before_after);
  memory.proven_m += way(T_before_after);
  memory.doubted_m += way(T_before_after);
}

void Recovery::observe(RecoveryMemory& memory, StreamId stream, const StreamModel& model,
                       const Event::Payload& z, const Pose2& believed, bool in_doubt) const {
  rivals_.weigh(memory.rivals, model, z, believed, std::min(1.0, memory.moved_m / options_.news_m));
  memory.moved_m = 0.0;
  remember(memory, stream, z, in_doubt);
}

void Recovery::remember(RecoveryMemory& memory, StreamId stream, const Event::Payload& z,
                        bool in_doubt) const {
  std::vector<Glimpse>& glimpses = memory.glimpses;
  memory.doubtful = in_doubt ? kDoubtfulScans : std::max(0, memory.doubtful - 1);
  if (memory.doubtful == 0) {
    glimpses.clear();
    memory.wait_s *= 0.5;
    return;
  }
  if (glimpses.empty()) memory.stream = stream;
  if (stream != memory.stream) return;
  // The newest one is replaced as long as it is near the one before it.
  if (glimpses.size() >= 2) {
    const Pose2 between_last_two =
        inverse(glimpses[glimpses.size() - 2].T_now_then) * glimpses.back().T_now_then;
    if (is_near(between_last_two, options_.spacing_m, options_.spacing_rad)) glimpses.pop_back();
  }
  if (glimpses.size() == static_cast<std::size_t>(options_.scans)) glimpses.erase(glimpses.begin());
  glimpses.push_back({z, Pose2{}});
}

bool Recovery::due(const RecoveryMemory& memory, Time now) const {
  if (!options_.active || memory.glimpses.empty()) return false;
  const double wait_s = std::max(memory.wait_s, options_.every_s);
  return !memory.searched || to_seconds(now - memory.searched_at) >= wait_s || now < memory.searched_at;
}

void Recovery::search(RecoveryMemory& memory, const StreamModel& model, Time now,
                      const Pose2& believed) const {
  if (!due(memory, now)) return;
  const auto found = model.search(memory.glimpses);
  if (!found) return;
  memory.searched = true;
  memory.searched_at = now;
  ++memory.searches;
  memory.wait_s = std::min(2.0 * std::max(memory.wait_s, options_.every_s), options_.at_most_every_s);
  const std::vector<double> gains = gains_of(*found, memory.glimpses, model, believed, rivals_, options_);
  const double prior = memory.carried ? options_.carried : options_.prior;
  const double before =
      std::log(prior / (1.0 - prior)) - std::log(static_cast<double>(std::max<std::size_t>(1, gains.size())));
  for (std::size_t i = 0; i < gains.size(); ++i) {
    rivals_.add(memory.rivals, {(*found)[i].T_map_base, before + gains[i], 0, 0.0, ++memory.last_id},
                believed);
  }
}

Eigen::Matrix3d Recovery::spread() {
  return Eigen::Vector3d(kSpread_m * kSpread_m, kSpread_m * kSpread_m, kSpread_rad * kSpread_rad)
      .asDiagonal();
}

bool Recovery::has_won(const RecoveryMemory& memory, const Rival& rival, Standing standing) const {
  const bool refuted = standing == Standing::kRefuted;
  const double accept = (refuted ? options_.refuted_accept : options_.accept) +
                        (standing == Standing::kTrusted && !memory.carried ? options_.sure : 0.0);
  if (rival.log_odds < accept) return false;
  const double probability = Rivals::share(memory.rivals, rival.log_odds);
  const bool best_of_few = rival.log_odds >= options_.hopeless && probability >= kBestOfFew;
  return best_of_few || probability >= (refuted ? options_.refuted_share : options_.share);
}

bool Recovery::take_over(RecoveryMemory& memory, std::span<const Hypothesis> places, Standing standing,
                         PoseFilter& filter) const {
  const int confirm = standing == Standing::kRefuted ? 0 : options_.confirm;
  Rival* const strongest = Rivals::strongest(memory.rivals, confirm);
  if (strongest == nullptr || !has_won(memory, *strongest, standing)) return false;
  const Rival winner = rivals_.take_over(memory.rivals, *strongest, places[0].T_map_base);
  for (const Hypothesis& place : places.subspan(1)) {
    const double log_odds = std::log(place.weight / places[0].weight) - winner.log_odds;
    rivals_.add(memory.rivals, {place.T_map_base, log_odds, 0, place.age_s, ++memory.last_id},
                winner.T_map_base);
  }
  begin_at(winner.T_map_base, ++memory.takeovers, filter);
  memory.wait_s = 0.0;
  memory.proven_m = 0.0;
  memory.settled_at_m = options_.settle_m;
  memory.carried = options_.continued > 0.0;
  return true;
}

void Recovery::begin_at(const Pose2& mean, std::uint32_t takeover, PoseFilter& filter) const {
  const RandomStream random(seed_, RandomPurpose::kCandidates, takeover);
  filter.initialize([&](const RandomStream&, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{mean.x + kSpread_m * n[0], mean.y + kSpread_m * n[1],
                 normalize_angle(mean.theta + kSpread_rad * n[2])};
  });
}

}  // namespace cairn
