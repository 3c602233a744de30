#include "cairn/bayes/particle_filter.hpp"

namespace cairn {

template class ParticleFilter<Pose2, Pose2>;

}  // namespace cairn
