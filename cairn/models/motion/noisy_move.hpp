#pragma once

#include "cairn/core/normal3_batch.hpp"
#include "cairn/core/normal_batch.hpp"
#include "cairn/core/pose2.hpp"

#include <span>

namespace cairn {

/// A motion split into turn, drive, turn, with the standard deviations of its parts: what remains of the
/// odometry and the options of DifferentialDrive once a whole batch of particles is to be moved.
struct NoisyMove {
  double turn1 = 0.0;
  double drive = 0.0;
  double turn2 = 0.0;
  double aside = 0.0;  ///< to the left while driving
  double sigma_turn1 = 0.0;
  double sigma_drive = 0.0;
  double sigma_turn2 = 0.0;
  double sigma_aside = 0.0;

  /// One state, with standard normal numbers for turn 1, drive, turn 2 and aside: the plain form, the oracle
  /// of the batch.
  Pose2 applied(const Pose2& state, double n_turn1, double n_drive, double n_turn2, double n_aside) const;

  bool operator==(const NoisyMove&) const = default;
  bool goes_aside() const { return aside != 0.0 || sigma_aside != 0.0; }
};

/// Moves all states on all lanes (see simd.hpp). Column i of the batch is for state i; the results are the
/// same bits on every path and in every batch.
///
/// Steps and their directions are computed in single precision and added to positions in double precision;
/// headings are counted in 2^-32 turns. From NoisyMove::applied differ headings by at most 4e-9 rad plus 4e-6
/// of the standard deviations of the turns, positions by at most 5e-7 of the way driven (mean and noise both
/// counted as positive) plus what the heading before the second turn differs.
/// @pre states.size() <= NormalBatch::kCapacity
void apply(const NoisyMove& move, std::span<Pose2> states, const NormalBatch& noise);

/// The same with the numbers for turn 1, drive and turn 2 alone. @pre states.size() <=
/// Normal3Batch::kCapacity and !move.goes_aside()
void apply(const NoisyMove& move, std::span<Pose2> states, const Normal3Batch& noise);

}  // namespace cairn
