#include "cairn/localization/witnesses.hpp"

namespace cairn {

void Witnesses::pass() {
  for (auto& testimony : last_)
    if (testimony && ++testimony->age > kStillHeard) testimony.reset();
}

void Witnesses::hear(StreamId stream, double evidence, double explained) {
  last_[stream] = Testimony{evidence > 0.0 && explained >= kExpected};
}

bool Witnesses::vouched(StreamId stream) const {
  for (std::size_t i = 0; i < last_.size(); ++i)
    if (i != stream && last_[i] && last_[i]->in_favour) return true;
  return false;
}

bool Witnesses::alone(StreamId stream) const {
  for (std::size_t i = 0; i < last_.size(); ++i)
    if (i != stream && last_[i]) return false;
  return true;
}

}  // namespace cairn
