#include "cairn/sim/radio_field.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kNearest_m = 0.1;  // levels do not grow without end

double loss_db(const WorldScene::Surface& surface, const WorldRadioOptions& o) {
  if (surface.thing == WorldScene::Thing::kPerson) return o.person_loss_db;
  if (surface.thing == WorldScene::Thing::kDoor) return o.door_loss_db;
  switch (surface.material) {
    case Material::kOpaque:
      return o.opaque_loss_db;
    case Material::kGlass:
      return o.glass_loss_db;
    case Material::kMesh:
      return o.mesh_loss_db;
    case Material::kMirror:
      return o.mirror_loss_db;
  }
  return 0.0;
}

}  // namespace

ShadowingField::ShadowingField(double sigma_db, double distance_m, std::uint64_t seed, std::uint64_t number)
    : amplitude_db_(sigma_db * std::sqrt(2.0 / kWaves)) {
  const RandomStream random = simulation_random(seed, SimulationUse::kShadowing, number);
  for (std::uint32_t i = 0; i < kWaves; ++i) {
    // A normal vector over the size of an independent normal number is Cauchy.
    const auto n = random.normal4(i);
    const double scale = 1.0 / (distance_m * std::max(1e-6, std::abs(n[2])));
    waves_[i] = {scale * n[0], scale * n[1], kTwoPi * random.uniform(i, 1)};
  }
}

double ShadowingField::at(const Point2& point) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.x * point.x + wave.y * point.y + wave.phase);
  return amplitude_db_ * sum;
}

double received_level_dbm(const WorldScene& scene, const WorldRadioOptions& o, const Point2& transmitter,
                          double power_dbm, const Point2& receiver) {
  const double distance = std::hypot(receiver.x - transmitter.x, receiver.y - transmitter.y);
  double level = power_dbm - 10.0 * o.path_loss_exponent * std::log10(std::max(kNearest_m, distance));
  scene.visit_between(receiver, transmitter, [&](const WorldScene::Surface& surface) {
    if (surface.span.contains(kAntennaHeight_m)) level -= loss_db(surface, o);
    return true;
  });
  return level;
}

int walls_on_line(const WorldScene& scene, const Point2& from, const Point2& to) {
  int walls = 0;
  scene.visit_between(from, to, [&walls](const WorldScene::Surface& surface) {
    const bool is_wall =
        surface.thing != WorldScene::Thing::kPerson && surface.span.contains(kAntennaHeight_m);
    walls += is_wall ? 1 : 0;
    return true;
  });
  return walls;
}

}  // namespace cairn
