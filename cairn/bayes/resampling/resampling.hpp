#pragma once

#include "cairn/bayes/filter_part.hpp"
#include "cairn/core/rng.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// The random numbers of one drawing of ancestors, all in (0, 1) and independent of each other and of those
/// of other drawings.
class DrawingNumbers {
 public:
  /// @param drawing number of the drawing within the step of the filter
  /// @param first number of particles that earlier drawings of the generation brought
  DrawingNumbers(const RandomStream& random, std::uint32_t drawing, std::uint32_t first = 0)
      : random_(random), drawing_(drawing), first_(first) {}

  /// For schemes that need a single number.
  double single() const { return random_.uniform(drawing_); }
  /// For schemes that need a number per particle: that of particle i.
  double of_particle(std::uint32_t i) const { return random_.uniform(first_ + i, kDraw); }
  /// A further number of a scheme that needs numbers per particle.
  double start() const { return random_.uniform(drawing_, kDraw + 1); }

 private:
  static constexpr std::uint16_t kDraw = 1000;  // beyond the draws that other parts use of the same stream

  RandomStream random_;
  std::uint32_t drawing_;
  std::uint32_t first_;
};

/// Draws the ancestors of the next generation from the weights of this one.
///
/// Every scheme draws index i count * w_i times in expectation, never an index without weight, and runs in
/// O(N + count). They differ in the variance of the counts (Douc, Cappe & Moulines, "Comparison of resampling
/// schemes for particle filtering", ISPA 2005).
class Resampling : public FilterPart {
 public:
  /// Appends `count` indices to `ancestors`.
  /// @param cumulative sums of the weights, as cumulative_weights() makes them: the last one is 1
  virtual void draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
                    std::vector<std::uint32_t>& ancestors) = 0;

  /// Says how the particles drawn since the last call are weighed, where that is not the same for all: adds
  /// to their log-weights, in the order of drawing, up to a common constant. Returns whether it did.
  virtual bool weigh_drawn(std::span<double> /*log_weights*/) { return false; }
};

}  // namespace cairn
