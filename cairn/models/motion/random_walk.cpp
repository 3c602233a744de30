#include "cairn/models/motion/random_walk.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {

void RandomWalkOptions::visit(OptionVisitor& v) {
  v.number({"sigma_m", "how far the robot strays in one second without odometry, metres; grows as sqrt(t)"},
           sigma_m, {0.0, 100.0});
  v.number({"sigma_rad", "likewise its heading, radians"}, sigma_rad, {0.0, 7.0});
}

double RandomWalkOptions::sigma_m_after(double seconds) const { return sigma_m * std::sqrt(seconds); }
double RandomWalkOptions::sigma_rad_after(double seconds) const { return sigma_rad * std::sqrt(seconds); }

void RandomWalk::propagate(const Pose2&, std::span<Pose2> states, const RandomStream& random) const {
  const double sigma_m = options_.sigma_m_after(seconds_), sigma_rad = options_.sigma_rad_after(seconds_);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto n = random.normal4(static_cast<std::uint32_t>(i));
    states[i] = {states[i].x + sigma_m * n[0], states[i].y + sigma_m * n[1],
                 normalize_angle(states[i].theta + sigma_rad * n[2])};
  }
}

}  // namespace cairn
