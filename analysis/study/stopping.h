// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/sequential_sign_test.h"

namespace scoria::analysis {

struct EpisodeRecord;

/// When a campaign ends before its seeds are spent: once each arm's comparison with the first is
/// decided.
struct StopRule {
  std::string when_decided = "falls";  // falls, or a metric by its key
  double alpha = 0.05;                 // of each comparison
  bool operator==(const StopRule&) const = default;
};

/// What a campaign that may stop by itself had seen when it ended.
struct StopRecord {
  /// An arm against the first, over the whole sweep.
  struct Compared {
    std::string a, b;
    double p_any_time = 1.0;
    bool operator==(const Compared&) const = default;
  };
  StopRule rule;
  int seeds = 0;                           // that were looked at
  std::optional<std::uint64_t> last_seed;  // after which it stopped; nothing: seeds were spent
  std::vector<Compared> comparisons;
  bool operator==(const StopRecord&) const = default;
};

/// "Stopped by itself after seed 23: falls of ags against sgs p = 0.012 at any time (level 5 % of
/// each)."
[[nodiscard]] std::string DescribeStop(const StopRecord& record);

[[nodiscard]] nlohmann::json ToJson(const StopRecord& record);
/// Errors: nlohmann::json::exception.
[[nodiscard]] StopRecord StopFromJson(const nlohmann::json& j);

/// Looks at a campaign seed by seed. Each comparison is a two-sided SequentialSignTest over the
/// seeds, so that one that has no difference is ever called decided with probability at most
/// alpha, however often one looks (Ville's inequality, [Ramdas2023]): in falls of the excess of one
/// arm, in a metric of the difference of the means over the sweep. A seed is one datum, with all
/// points of the sweep.
class SequentialStop {
 public:
  /// @param rule  of falls, or a metric that there is.
  /// @param arms  the first is what the others are compared with; two at least.
  SequentialStop(const StopRule& rule, const std::vector<std::string>& arms);

  /// @param episodes  all of one seed, in the order of the seeds. @pre !decided().
  void AddSeed(std::uint64_t seed, std::span<const EpisodeRecord> episodes);

  /// Whether each comparison is decided.
  [[nodiscard]] bool decided() const noexcept { return record_.last_seed.has_value(); }
  [[nodiscard]] const StopRecord& record() const noexcept { return record_; }

 private:
  [[nodiscard]] std::optional<double> Difference(std::span<const EpisodeRecord> episodes,
                                                 const std::string& a, const std::string& b) const;

  std::optional<Metric> metric_;  // nothing: falls
  std::vector<SequentialSignTest> tests_;
  StopRecord record_;
};

}  // namespace scoria::analysis
