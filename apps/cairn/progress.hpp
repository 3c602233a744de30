#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace cairn::app {

/// Shows on standard error how far long work is: a bar with the time left on a terminal, one line per 10 %
/// otherwise. Says nothing about work that ends within half a second.
class Progress {
 public:
  Progress(std::string label, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Call as often as you like: it looks at the clock once in a while only.
  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(std::int64_t done, double elapsed_s);
  void print_line(std::int64_t done, double elapsed_s);

  std::string label_;
  std::int64_t total_;
  bool terminal_;
  bool drawn_ = false;
  int last_tenth_ = 0;
  Clock::time_point started_ = Clock::now();
  Clock::time_point drawn_at_ = started_;
};

}  // namespace cairn::app
