#pragma once

#include "cairn/localization/estimate.hpp"
#include "cairn/localization/measurement.hpp"
#include "cairn/localization/sliding_vector.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace cairn {

/// The measurements of the last few seconds in the order of their stamps, and the belief before some of them.
///
/// A measurement that comes late is put at its true time: the belief goes back to the last checkpoint before
/// it, and everything from there on is applied once more. Whatever the order of arrival, the belief is
/// therefore that of the sorted order, to the last bit, as long as nothing is older than the history.
///
/// `Belief` has a movable, default-constructible `Checkpoint`, `save(Checkpoint&) const` and
/// `restore(const Checkpoint&)`. Does not touch the heap once it has grown to its largest size.
template <class Belief>
class History {
 public:
  struct Entry {
    Measurement measurement;
    Outcome outcome = Outcome::kPending;  ///< of the last time that it was applied
    bool late = false;                    ///< later ones were applied before it came
    Duration cost{0};                     ///< of the last time that it was applied; apply() sets it
    Duration total{0};                    ///< of all that was applied up to it, from some common beginning
  };

  static constexpr std::size_t kMostEntries = 4096;
  static constexpr std::size_t kCheckpoints = 24;

  /// @param span how far back the history reaches from the newest measurement; zero: not at all
  explicit History(Duration span) : span_(span), spacing_(span / kSpaces) {}

  Duration span() const { return span_; }
  bool empty() const { return entries_.empty(); }
  const SlidingVector<Entry>& entries() const { return entries_; }
  std::size_t checkpoints() const { return used_; }
  /// The oldest belief that catch_up() may go back to; nullptr if it cannot go back.
  const typename Belief::Checkpoint* oldest() const { return used_ > 0 ? &slots_[0].belief : nullptr; }
  /// Number of times that the belief went back.
  std::int64_t rewinds() const { return rewinds_; }

  bool contains(const TimelineKey& key) const {
    if (span_ == Duration{0}) {
      return std::any_of(entries_.begin(), entries_.end(),
                         [&](const Entry& e) { return key_of(e.measurement) == key; });
    }
    const std::size_t place = place_of(key);
    return place < entries_.size() && key_of(entries_[place].measurement) == key;
  }

  /// True for what can no longer be put at its place.
  bool is_stale(Time stamp) const {
    if (!entries_.empty() && span_ == Duration{0}) return stamp < newest();
    return reach_ && stamp < *reach_;
  }

  /// Cost of all that would have to be done again if a measurement were put at this place.
  Duration redo_cost(const TimelineKey& key) const {
    if (used_ == 0 || applied_ == 0) return Duration{0};
    const std::size_t place = place_of(key);
    if (place >= applied_) return Duration{0};
    std::size_t slot = used_ - 1;
    while (slot > 0 && slots_[slot].index > place) --slot;
    const Entry& first = entries_[slots_[slot].index];
    return entries_[applied_ - 1].total - first.total + first.cost;
  }

  /// Puts a measurement at its place; catch_up() applies it. @pre !is_stale(stamp), !contains(key)
  void insert(Measurement measurement) {
    const bool ordered = span_ > Duration{0};
    const std::size_t place = ordered ? place_of(key_of(measurement)) : entries_.size();
    const bool late = place < applied_;
    if (late) redo_from(place);
    entries_.insert(place, {std::move(measurement), Outcome::kPending, late});
  }

  /// Something that measurements after `stamp` depend on has changed: catch_up() applies them again.
  void redo_after(Time stamp) {
    if (entries_.empty() || span_ == Duration{0} || newest() <= stamp) return;
    const auto later = std::upper_bound(entries_.begin(), entries_.end(), stamp,
                                        [](Time t, const Entry& e) { return t < e.measurement.event.stamp; });
    redo_from(static_cast<std::size_t>(later - entries_.begin()));
  }

  /// Applies all that is not applied, in order: `apply(entry, again)` has to set the entry's outcome and
  /// cost; `again` tells that it had been applied before. Returns how far the belief went back for it.
  template <class Apply>
  Duration catch_up(Belief& belief, const Apply& apply) {
    const Duration depth = redo_ ? go_back(belief) : Duration{0};
    for (; applied_ < entries_.size(); ++applied_) {
      if (span_ > Duration{0}) keep_checkpoint(belief);
      Entry& entry = entries_[applied_];
      apply(entry, entry.outcome != Outcome::kPending);
      entry.total = (applied_ > 0 ? entries_[applied_ - 1].total : Duration{0}) + entry.cost;
    }
    return depth;
  }

  /// Stamp from which on measurements are still needed if the newest is at `newest`.
  Time wanted_from() const { return entries_.empty() ? Time::min() : newest() - span_; }

  /// Drops what is older than `stamp`, as far as checkpoints allow. @pre everything is applied
  void forget_before(Time stamp) {
    if (entries_.size() > kMostEntries) {
      stamp = std::max(stamp, entries_[entries_.size() - kMostEntries / 2].measurement.event.stamp);
    }
    reach_ = std::max(reach_.value_or(stamp), stamp);
    span_ > Duration{0} ? drop_to_checkpoint(stamp) : drop_all_but_newest();
  }

  /// The clock was set back: nothing of before can be reached any more.
  void restart() {
    entries_.clear();
    used_ = 0;
    applied_ = 0;
    redo_.reset();
    reach_.reset();
  }

 private:
  static constexpr int kSpaces = 14;  ///< between checkpoints; those after late measurements come on top

  /// The belief before entries_[index].
  struct Slot {
    typename Belief::Checkpoint belief;
    std::size_t index = 0;
    Time stamp;
  };

  Time newest() const { return entries_.back().measurement.event.stamp; }

  std::size_t place_of(const TimelineKey& key) const {
    if (entries_.empty() || key_of(entries_.back().measurement) < key) return entries_.size();
    const auto found =
        std::lower_bound(entries_.begin(), entries_.end(), key,
                         [](const Entry& e, const TimelineKey& k) { return key_of(e.measurement) < k; });
    return static_cast<std::size_t>(found - entries_.begin());
  }

  // The belief is to be that before entries_[place] again.
  void redo_from(std::size_t place) {
    if (place >= applied_) return;
    redo_ = std::min(redo_.value_or(place), place);
    while (used_ > 1 && slots_[used_ - 1].index > place) --used_;
  }

  Duration go_back(Belief& belief) {
    redo_.reset();
    const Slot& slot = slots_[used_ - 1];
    const Duration depth = newest() - entries_[slot.index].measurement.event.stamp;
    belief.restore(slot.belief);
    applied_ = slot.index;
    ++rewinds_;
    return depth;
  }

  // After what came late, too: what comes late next is of the same stream, and a little newer.
  void keep_checkpoint(const Belief& belief) {
    const Time stamp = entries_[applied_].measurement.event.stamp;
    if (used_ > 0) {
      const Slot& last = slots_[used_ - 1];
      if (last.index == applied_) return;
      const bool after_late = entries_[applied_ - 1].late && !entries_[applied_].late;
      const bool far = stamp - last.stamp >= spacing_ || applied_ - last.index >= kMostEntries / kCheckpoints;
      if (!far && !after_late) return;
    }
    if (used_ == kCheckpoints) thin();
    if (used_ == slots_.size()) slots_.emplace_back();
    Slot& slot = slots_[used_++];
    belief.save(slot.belief);
    slot.index = applied_;
    slot.stamp = stamp;
  }

  // Every second checkpoint goes, but not the first.
  void thin() {
    std::size_t kept = 1;
    for (std::size_t i = 2; i < used_; i += 2) std::swap(slots_[kept++], slots_[i]);
    used_ = kept;
  }

  void drop_to_checkpoint(Time stamp) {
    std::size_t first = 0;
    while (first + 1 < used_ && slots_[first + 1].index > 0 &&
           entries_[slots_[first + 1].index - 1].measurement.event.stamp < stamp) {
      ++first;
    }
    if (first == 0) return;
    const std::size_t count = slots_[first].index;
    entries_.drop_front(count);
    applied_ -= count;
    std::rotate(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(first), slots_.end());
    used_ -= first;
    for (std::size_t i = 0; i < used_; ++i) slots_[i].index -= count;
  }

  void drop_all_but_newest() {
    if (entries_.size() <= 1) return;
    std::size_t keep = entries_.size() - 1;
    while (keep > 0 && entries_[keep - 1].measurement.event.stamp == newest()) --keep;
    entries_.drop_front(keep);
    applied_ -= keep;
  }

  Duration span_;
  Duration spacing_;
  SlidingVector<Entry> entries_;
  std::vector<Slot>
      slots_;  ///< the first used_ are checkpoints, in the order of their stamps; the rest is room
  std::size_t used_ = 0;
  std::size_t applied_ = 0;          ///< entries that are in the belief: the first so many
  std::optional<std::size_t> redo_;  ///< the first entry that has to be applied again
  std::optional<Time> reach_;
  std::int64_t rewinds_ = 0;
};

}  // namespace cairn
