// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/study/results.h"
#include "app/scenario/expectation.h"
#include "app/scenario/observable.h"

namespace scoria::app {

/// One bound, and what was found.
struct Finding {
  std::string name;             // as the file writes it, with the arm where there are several
  std::optional<double> value;  // nothing where it does not apply
  std::string problem;          // why the bound is not met, in words; empty if it is
};

/// Episodes that are judged together: their values are pooled as each metric says.
using Episodes = std::vector<const analysis::EpisodeRecord*>;

/// Judges episodes by what is expected of them. Reads the registry once.
class ExpectationJudge {
 public:
  /// A finding for each expectation, in their order. One that does not apply is not met.
  /// @param arm  is named in the findings; empty: none.
  [[nodiscard]] std::vector<Finding> Compare(const Expectations& expected, const Episodes& episodes,
                                             const std::string& arm = "") const;

 private:
  [[nodiscard]] std::optional<double> ValueOf(const Observable& what,
                                              const Episodes& episodes) const;
  [[nodiscard]] std::string WhyNone(const Observable& what, const Episodes& episodes) const;

  Observables observables_ = AllObservables();
  analysis::Metrics metrics_ = analysis::AllMetrics();
};

/// Why an episode was no walk at all, whatever was expected of it; empty if it was one.
[[nodiscard]] std::string DescribeNoWalk(const analysis::EpisodeRecord& episode);

}  // namespace scoria::app
