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
/// Each arm at each point of the sweep is looked at by itself, because what becomes worse on one
/// ground is lost in a mean over all; the average pays for it with the logarithm of their number. A
/// difference counts as positive where it is for the worse. Values that hardly repeat between the
/// seeds of the baseline are averages over an episode: they go into SequentialTTest. All others go
/// into SequentialSignTest: falls by the excess of this build over the baseline.
///
/// The scale of the t-test is known from the start. A twin gives it: the baseline once more, by
/// other bits of no consequence. Where this build has none either, baseline, twin and now are drawn
/// alike, given the seed; with normal spread the difference of the first two is independent of now
/// minus their mean, so that the squares of the one are a pilot for the other. Where the twin's
/// differences repeat, or one of them outweighs all others, and where there is no twin, the spread
/// of the baseline's seeds stands in: two walks on one seed do not differ more than √2 times as
/// widely, which errs on the safe side, by far where a seed says most of how a walk goes.
class RegressionEvidence {
 public:
  /// An arm at a point of the sweep.
  struct Place {
    std::string arm;
    std::vector<std::string> point;
    auto operator<=>(const Place&) const = default;
  };

  /// @param baseline  of as many seeds as there are, ten at least where SequentialTTest is to be
  /// used.
  /// @param twin  of seeds of the baseline, ten at least; without episodes there is none.
  explicit RegressionEvidence(const CampaignResults& baseline, CampaignResults twin = {});

  /// The episodes of one seed, of the baseline and now; other seeds are left out.
  void AddSeed(std::uint64_t seed, const CampaignResults& baseline, const CampaignResults& now);

  struct Line {
    MetricInfo metric;
    Place place;
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
    Metric metric;
    Place place;
    std::variant<SequentialSignTest, SequentialTTest> test;
    bool by_twin = false;  // the twin gives its scale
    long pairs = 0;
    double baseline_sum = 0.0, sum = 0.0;
    [[nodiscard]] double log_e() const;
    void Add(double before, double now, double worse);
  };
  [[nodiscard]] Test MakeTest(const Metric& metric, const Place& place,
                              const CampaignResults& baseline) const;
  static void AddPair(const EpisodeRecord& before, const EpisodeRecord* twin,
                      const EpisodeRecord& now, Test& test);

  CampaignResults twin_;
  std::vector<Test> tests_;
  EProcess evidence_;
};

}  // namespace scoria::analysis
