#pragma once

#include <cstdint>
#include <span>

namespace cairn {

// Functions of many numbers at once, on all lanes of the processor; the same bits on every path of simd.hpp,
// for every element alone and in any batch.

/// out[i] = exp(values[i] + offset), within 2 units of the last place; 0 below -708, exp(709) beyond 709.
/// `out` may be `values`. @pre out.size() == values.size()
void exp_all(std::span<const double> values, double offset, std::span<double> out);

/// sine[i], cosine[i] of angles[i], |angle| < 1e6, within 2^-52. @pre equal sizes
void sine_cosine_all(std::span<const double> angles, std::span<double> sine, std::span<double> cosine);

/// The largest of them. @pre not empty, all numbers
double largest_of(std::span<const double> values);

/// The sum in a fixed order: eight partial sums side by side, added in the end.
double sum_of(std::span<const double> values);

/// The sum of squares, likewise.
double sum_of_squares(std::span<const double> values);

/// The sum of a[i] * b[i], likewise. @pre equal sizes
double dot(std::span<const double> a, std::span<const double> b);

}  // namespace cairn
