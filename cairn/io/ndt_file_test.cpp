#include "cairn/io/ndt_file.hpp"

#include "cairn/core/errors.hpp"
#include "mini_maps.hpp"

#include <sstream>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::string written() {
  std::ostringstream out;
  write_ndt(out, ndt_from_grid(test::mini_room({0.1, 0.2, 0.3}), {}));
  return out.str();
}

void read_text(const std::string& text) {
  std::istringstream in(text);
  read_ndt(in, "a.ndt");
}

TEST(NdtFile, IsReadBackToTheLastBit) {
  const std::string text = written();
  EXPECT_TRUE(looks_like_ndt(text.substr(0, 32)));
  std::istringstream in(text);
  std::ostringstream again;
  write_ndt(again, *read_ndt(in, "a.ndt"));
  EXPECT_EQ(again.str(), text);
}

TEST(NdtFile, CutAnywhereIsAnError) {
  const std::string text = written();
  const std::size_t last_field = text.find_last_of(' ');
  for (std::size_t length = 0; length < last_field; length += 97) {
    EXPECT_THROW(read_text(text.substr(0, length)), InputError) << length;
  }
}

TEST(NdtFile, RefusesWhatIsNone) {
  const std::string head = "cairn-ndt 1\ncell_size_m 0.5\norigin 0 0 0\nsize 2 2\n";
  read_text(head + "cells 1\n0 3 0.1 0.1 0.01 0 0.01 1\n");
  for (const char* bad :
       {"cells 1\n99 3 0.1 0.1 0.01 0 0.01 1\n", "cells 1\n0 3 nan 0.1 0.01 0 0.01 1\n",
        "cells 1\n0 3 0.1 0.1 0.01 1 0.01 1\n", "cells 1\n0 3 0.1 0.1 0.01 0 0.01 2\n", "cells 99999999999\n",
        "cells -1\n", "cells 2\n0 3 0.1 0.1 0.01 0 0.01 1\n", "cells 1\n0 3 0.1 0.1 0.01 0 0.01 1 7\n"}) {
    EXPECT_THROW(read_text(head + bad), InputError) << bad;
  }
  EXPECT_THROW(read_text("cairn-ndt 2\n"), InputError);
  EXPECT_THROW(read_text("cairn-ndt 1\ncell_size_m 0.5\norigin 0 0 0\nsize 50000000 50000000\ncells 0\n"),
               InputError);
}

}  // namespace
}  // namespace cairn
