#pragma once

#include "apps/cairn/commands.hpp"

#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace cairn::test {

/// What the subcommand that `add` registers prints on standard output when the program is called with
/// `arguments`
/// ("score --reference a ..."). Fails the test unless the exit code is 0; passes on what the command throws.
inline std::string output_of(void (*add)(CLI::App&, app::Runner&), const std::string& arguments) {
  CLI::App program;
  app::Runner run;
  add(program, run);
  program.parse(arguments);
  std::ostringstream output;
  auto* const console = std::cout.rdbuf(output.rdbuf());
  const auto restore = [console](void*) { std::cout.rdbuf(console); };
  const std::unique_ptr<void, decltype(restore)> guard(&output, restore);
  EXPECT_EQ(run(), app::kOk);
  return output.str();
}

}  // namespace cairn::test
