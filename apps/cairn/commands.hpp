#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace cairn::app {

/// Exit codes of the program: the contract that scripts rely on.
inline constexpr int kOk = 0;
inline constexpr int kFailed = 1;  ///< anything else; also a run that Ctrl-C ended early, its results written
inline constexpr int kUsage = 2;
inline constexpr int kBadInput = 3;
inline constexpr int kLost = 4;

/// Runs the chosen subcommand and returns the exit code.
using Runner = std::function<int()>;

// One file per subcommand: each adds its options to `program` and, when chosen, sets `run`.
void add_config(CLI::App& program, Runner& run);
void add_evaluate(CLI::App& program, Runner& run);
void add_kidnap(CLI::App& program, Runner& run);
void add_localize(CLI::App& program, Runner& run);
void add_locate(CLI::App& program, Runner& run);
void add_log(CLI::App& program, Runner& run);
void add_map(CLI::App& program, Runner& run);
void add_replay(CLI::App& program, Runner& run);
void add_report(CLI::App& program, Runner& run);
void add_score(CLI::App& program, Runner& run);
void add_simulate(CLI::App& program, Runner& run);
void add_tune(CLI::App& program, Runner& run);

}  // namespace cairn::app
