// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/sequential_sign_test.h"
#include "analysis/statistics/sequential_t_test.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// Evidence that episodes are worse than those of a baseline on the same seeds, as seeds come in:
/// one number for each metric that has a better direction and no clock in it, and their average,
/// which is evidence against "nothing became worse" that may be looked at after every seed
/// (e_process.h). By Ville's inequality it ever reaches 1 / α with probability at most α, if
/// nothing did, however many metrics there are and however they depend on each other.
///
/// A seed's value of a metric is its mean over arms and points of the sweep, of those episodes that
/// have it in both; a difference counts as positive where it is for the worse. Values that hardly
/// repeat between the seeds of the baseline are averages over an episode: they go into
/// SequentialTTest, whose scale the spread of the baseline's seeds gives from the start.
/// Differences between two walks on one seed do not spread more than √2 times as wide, so that this
/// errs on the safe side. All others, falls among them, go into SequentialSignTest.
class RegressionEvidence {
 public:
  /// @param baseline  of as many seeds as there are, ten at least where SequentialTTest is to be
  /// used.
  explicit RegressionEvidence(const CampaignResults& baseline);

  /// The episodes of one seed, of the baseline and now; other seeds are left out.
  void AddSeed(std::uint64_t seed, const CampaignResults& baseline, const CampaignResults& now);

  struct Line {
    MetricInfo metric;
    long pairs = 0;
    double baseline_mean = 0.0, mean = 0.0;
    double log_e = 0.0;  // natural logarithm, now
  };
  /// Strongest first; without those that no pair has.
  [[nodiscard]] std::vector<Line> Lines() const;

  /// Of the average over all metrics.
  [[nodiscard]] const EProcess& evidence() const noexcept { return evidence_; }

 private:
  struct Test {
    MetricInfo metric;
    std::variant<SequentialSignTest, SequentialTTest> test;
    long pairs = 0;
    double baseline_sum = 0.0, sum = 0.0;
    [[nodiscard]] double log_e() const;
  };
  Metrics metrics_;
  std::vector<Test> tests_;
  EProcess evidence_;
};

}  // namespace scoria::analysis
