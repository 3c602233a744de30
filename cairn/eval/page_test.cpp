#include "cairn/eval/page.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Page, PutsTheDataInPlaceOfTheMark) {
  EXPECT_EQ(fill_page("a<!--CAIRN:RUN-->b", R"({"x": "</script>"})"), R"(a{"x": "\u003c/script>"}b)");
}

TEST(Page, APageWithoutTheMarkIsABug) { EXPECT_THROW(fill_page("a", "{}"), std::logic_error); }

}  // namespace
}  // namespace cairn
