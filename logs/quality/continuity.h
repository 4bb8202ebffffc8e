// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "logs/quality/tick.h"

namespace scoria::logs {

/// Tells whether the robot moved on between two samples, or no time passed between them whatever
/// their stamps say: by how far joints and position move from sample to sample at other times.
class Continuity {
 public:
  enum class Verdict { kContinues, kJumps, kNotEnoughMotion };

  /// Judges the step from the last sample to this one.
  /// @param samples  that would lie between the two if time had passed.
  [[nodiscard]] Verdict Judge(const Tick& sample, double samples) const;

  /// Takes a sample. @param is_neighbour  of the last one: nothing is missing between them.
  void Add(const Tick& sample, bool is_neighbour);

 private:
  /// One signal: its last value, how far it moves from sample to sample, and how far in all.
  template <int kSize>
  class Course {
   public:
    using Vector = Eigen::Matrix<double, kSize, 1>;
    void Add(const Vector& value, bool is_neighbour);
    [[nodiscard]] std::optional<Verdict> Judge(const Vector& value, double samples,
                                               double least_motion) const;

   private:
    static constexpr double kStepMemory = 0.05, kMemory = 0.005;  // shares of a new sample
    std::optional<Vector> last_;
    Vector mean_ = Vector::Zero();
    double step_ = 0.0;  // running mean of the steps' sizes
    double variance_ = 0.0;
  };

  Course<kNumJoints> joints_;
  Course<3> position_;
};

}  // namespace scoria::logs
