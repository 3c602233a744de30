#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cairn {

/// The numbers that the parts of a filter carry from one step to the next, in the order of saving.
class PartMemory {
 public:
  void clear() { numbers_.clear(); }
  void put(double number) { numbers_.push_back(number); }

  /// Reads what was put, from the front.
  class Reader {
   public:
    explicit Reader(const PartMemory& memory) : left_(memory.numbers_) {}
    double take() {
      const double number = left_.front();
      left_ = left_.subspan(1);
      return number;
    }

   private:
    std::span<const double> left_;
  };

 private:
  std::vector<double> numbers_;
};

/// An exchangeable part of a filter. One that remembers something between two steps of the filter saves and
/// loads it, so that a checkpoint of the filter is complete; a mere scratch buffer need not.
class FilterPart {
 public:
  virtual ~FilterPart() = default;

  /// Puts every number that later steps depend on.
  virtual void save(PartMemory& /*memory*/) const {}
  /// Takes the same numbers in the same order.
  virtual void load(PartMemory::Reader& /*memory*/) {}
};

}  // namespace cairn
