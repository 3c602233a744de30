#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cairn {

/// A vector that is filled at the back and emptied at the front, like a deque, but which does not touch the
/// heap once it has grown to its largest size: the room of dropped elements is used again.
template <class T>
class SlidingVector {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;

  bool empty() const { return first_ == items_.size(); }
  std::size_t size() const { return items_.size() - first_; }
  T& operator[](std::size_t i) { return items_[first_ + i]; }
  const T& operator[](std::size_t i) const { return items_[first_ + i]; }
  T& front() { return items_[first_]; }
  const T& front() const { return items_[first_]; }
  T& back() { return items_.back(); }
  const T& back() const { return items_.back(); }
  iterator begin() { return items_.begin() + offset(); }
  iterator end() { return items_.end(); }
  const_iterator begin() const { return items_.begin() + offset(); }
  const_iterator end() const { return items_.end(); }

  void push_back(T item) {
    make_room();
    items_.push_back(std::move(item));
  }

  /// Puts an item before the one at `index` (size(): at the end).
  void insert(std::size_t index, T item) {
    make_room();
    items_.insert(begin() + static_cast<std::ptrdiff_t>(index), std::move(item));
  }

  void erase(std::size_t index) { items_.erase(begin() + static_cast<std::ptrdiff_t>(index)); }

  /// Drops the first `count` items; what they hold is released at once.
  void drop_front(std::size_t count) {
    std::fill_n(begin(), count, T{});
    first_ += count;
    if (empty()) clear();
  }

  void clear() {
    items_.clear();
    first_ = 0;
  }

  /// Keeps the items for which `keep` holds, in their order.
  template <class Keep>
  void retain(const Keep& keep) {
    items_.erase(std::remove_if(begin(), end(), [&](const T& item) { return !keep(item); }), items_.end());
  }

 private:
  std::ptrdiff_t offset() const { return static_cast<std::ptrdiff_t>(first_); }

  // Moves the items to the front rather than growing, where that frees enough room to be worth it.
  void make_room() {
    if (items_.size() < items_.capacity() || first_ == 0 || first_ * 2 < items_.size()) return;
    items_.erase(items_.begin(), begin());
    first_ = 0;
  }

  std::vector<T> items_;
  std::size_t first_ = 0;
};

}  // namespace cairn
