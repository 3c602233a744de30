#pragma once

#include "apps/cairn/posed_scans.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace cairn::app {

/// PosedScanOptions as a command line gives them.
struct PosedScanArguments {
  std::string stream, mount;
  std::string frame = "base";
  double max_gap_s = PosedScanOptions{}.max_gap_s;

  /// @throws ConfigurationError for a mount that is no pose, or an unknown frame
  PosedScanOptions options() const;
};

/// Adds --stream, --mount, --trajectory-frame and --max-gap-s.
void add_posed_scan_options(CLI::App& command, PosedScanArguments& arguments);

}  // namespace cairn::app
