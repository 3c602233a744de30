#include "apps/cairn/progress.hpp"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::app {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

void wait_ms(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

// Standard error of a test is no terminal: lines, not a bar.
template <class Work>
std::string said(const Work& work) {
  testing::internal::CaptureStderr();
  work();
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, SaysNothingAboutShortWork) {
  const std::string text = said([] {
    Progress progress("working", 1000);
    for (int i = 0; i <= 1000; ++i) progress.update(i);
  });
  EXPECT_EQ(text, "");
}

TEST(Progress, SaysHowFarLongWorkIsOncePerTenth) {
  const std::string text = said([] {
    Progress progress("working", 1000);
    wait_ms(600);
    for (const int done : {250, 260, 1000}) {
      progress.update(done);
      wait_ms(110);
    }
  });
  EXPECT_THAT(text, MatchesRegex("working: 20 %, [0-9]+ s left\nworking: 100 %\n"));
}

TEST(Progress, TakesWorkOfUnknownSize) {
  const std::string text = said([] {
    Progress progress("working", 0);
    wait_ms(600);
    progress.update(0);
    wait_ms(110);
    progress.update(1);
  });
  EXPECT_THAT(text, HasSubstr("100 %"));
}

}  // namespace
}  // namespace cairn::app
