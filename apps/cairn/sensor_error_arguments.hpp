#pragma once

#include "apps/cairn/posed_scan_arguments.hpp"
#include "apps/cairn/sensor_errors.hpp"

#include <string>

#include <CLI/CLI.hpp>

namespace cairn::app {

/// What measure_sensor_errors needs, as a command line gives it.
struct SensorErrorArguments {
  std::string log, map, reference, world, odometry;
  PosedScanArguments scans;
};

/// Adds --log, --map, --reference, --world, --odometry and those of add_posed_scan_options.
void add_sensor_error_options(CLI::App& command, SensorErrorArguments& arguments);

/// Reads the files and measures.
/// @throws InputError, ConfigurationError as the readers and measure_sensor_errors
SensorErrors measure(const SensorErrorArguments& arguments);

}  // namespace cairn::app
