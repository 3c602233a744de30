// Where MRPT is not installed.
#include "registration.hpp"

namespace cairn::bench {

void register_peer() {}

}  // namespace cairn::bench
