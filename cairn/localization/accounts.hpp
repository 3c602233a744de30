#pragma once

#include "cairn/localization/estimate.hpp"
#include "cairn/sensing/event.hpp"

#include <vector>

namespace cairn {

/// What became of every message, per stream. Each stands under exactly one outcome at any time, so that the
/// row of a stream sums to the messages that it sent.
class Accounts {
 public:
  explicit Accounts(std::size_t streams) : table_(streams) {}

  /// A message came in, with its first outcome.
  void open(StreamId stream, Outcome outcome) { ++at(stream, outcome); }

  /// The outcome of a message of before has changed.
  void move(StreamId stream, Outcome from, Outcome to) {
    --at(stream, from);
    ++at(stream, to);
  }

  const std::vector<OutcomeCounts>& table() const { return table_; }

 private:
  std::int64_t& at(StreamId stream, Outcome outcome) {
    return table_[stream][static_cast<std::size_t>(outcome)];
  }

  std::vector<OutcomeCounts> table_;
};

}  // namespace cairn
