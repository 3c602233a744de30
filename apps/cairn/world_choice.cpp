#include "apps/cairn/world_choice.hpp"

namespace cairn::app {

bool is_built_in_world(const std::string& name) { return name == "office"; }

}  // namespace cairn::app
