#include "apps/cairn/progress.hpp"

#include <algorithm>
#include <cstdio>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace cairn::app {
namespace {

constexpr double kQuiet_s = 0.5;
constexpr double kRedraw_s = 0.1;
constexpr int kBarWidth = 30;

std::string time_left(std::int64_t done, std::int64_t total, double elapsed_s) {
  if (done <= 0 || done >= total) return "";
  const double left_s = elapsed_s * static_cast<double>(total - done) / static_cast<double>(done);
  return left_s < 90.0 ? fmt::format("{:.0f} s left", left_s) : fmt::format("{:.0f} min left", left_s / 60.0);
}

}  // namespace

Progress::Progress(std::string label, std::int64_t total)
    : label_(std::move(label)),
      total_(std::max<std::int64_t>(total, 1)),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_ && terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(std::int64_t done) {
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - drawn_at_).count() < kRedraw_s) return;
  drawn_at_ = now;
  const double elapsed_s = std::chrono::duration<double>(now - started_).count();
  if (elapsed_s < kQuiet_s) return;
  terminal_ ? draw_bar(done, elapsed_s) : print_line(done, elapsed_s);
  drawn_ = true;
}

void Progress::draw_bar(std::int64_t done, double elapsed_s) {
  const auto filled = static_cast<std::size_t>(kBarWidth * std::min(done, total_) / total_);
  fmt::print(stderr, "\r\033[K{} [{}{}] {:3d} %  {}", label_, std::string(filled, '#'),
             std::string(kBarWidth - filled, '.'), 100 * done / total_, time_left(done, total_, elapsed_s));
  std::fflush(stderr);
}

void Progress::print_line(std::int64_t done, double elapsed_s) {
  const int tenth = static_cast<int>(10 * done / total_);
  if (tenth <= last_tenth_) return;
  last_tenth_ = tenth;
  const std::string left = time_left(done, total_, elapsed_s);
  fmt::print(stderr, "{}: {} %{}\n", label_, 10 * tenth, left.empty() ? "" : ", " + left);
}

}  // namespace cairn::app
