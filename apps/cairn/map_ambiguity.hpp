#pragma once

#include "apps/cairn/commands.hpp"

namespace cairn::app {

/// `cairn map ambiguity`: where a map looks alike to a laser scanner, with which other poses, and how far a
/// robot must drive to tell them apart.
void add_map_ambiguity(CLI::App& parent, Runner& run);

}  // namespace cairn::app
