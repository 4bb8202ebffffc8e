// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "logs/interval_histogram.h"
#include "logs/quality/continuity.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/span_list.h"

namespace scoria::logs {

/// The times of rows: gaps, steps of the clock, lost samples, bursts, repetitions, times that go
/// back. A step is told from a gap by the joints and the place of the robot, which go on as if no
/// time had passed.
class ClockCheck : public QualityCheck {
 public:
  /// From here on a pause is a gap: contacts and strides within it are not known.
  static constexpr double kShortestGap_s = 0.1;

  explicit ClockCheck(const LogSubject& subject) : subject_(subject) {}
  void AddRow(const Row& row) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  void AddStep(double step_s, double time_s, const Tick& sample);
  [[nodiscard]] std::vector<Finding> Gaps() const;
  [[nodiscard]] std::optional<Finding> LostSamples() const;
  [[nodiscard]] std::optional<Finding> IrregularTimes() const;

  LogSubject subject_;
  Continuity continuity_;
  std::optional<double> last_s_;
  double first_s_ = 0.0, longest_s_ = 0.0, gap_s_ = 0.0;
  double period_s_ = 0.0;  // running mean of short steps
  std::uint64_t rows_ = 0, repeated_ = 0;
  IntervalHistogram steps_;
  SpanList gaps_, unsure_gaps_, backwards_;
  struct ClockStep {
    double time_s = 0.0, size_s = 0.0;
  };
  std::vector<ClockStep> clock_steps_;  // the first kMostSpans
  std::uint64_t num_clock_steps_ = 0;
};

}  // namespace scoria::logs
