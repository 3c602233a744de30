#pragma once

namespace cairn::app {

/// While it lives, Ctrl-C (SIGINT) and SIGTERM ask the work to end early instead of killing the program; a
/// second one kills it. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;
};

}  // namespace cairn::app
