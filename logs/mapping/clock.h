// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "logs/mapping/mapping_file.h"

namespace scoria::logs {

/// Stamps from here on are times since 1970: 2000-01-01.
inline constexpr std::int64_t kYear2000_ns = 946'684'800'000'000'000;

/// Numbers of which so many are kept, each with the same chance; the same ones in every run.
class Reservoir {
 public:
  void Add(std::int64_t value);
  [[nodiscard]] bool IsEmpty() const { return values_.empty(); }
  /// @param share  0 the smallest, 0.5 the median, 1 the largest. @pre not empty.
  [[nodiscard]] std::int64_t Quantile(double share) const;

 private:
  static constexpr std::size_t kMost = 8192;
  std::vector<std::int64_t> values_;
  std::uint64_t seen_ = 0;
  std::minstd_rand random_;
};

/// Collects what the times of one clock are like.
class ClockStatistics {
 public:
  void Add(std::int64_t time_ns);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t num_back() const { return num_back_; }
  [[nodiscard]] std::int64_t largest_ns() const { return largest_ns_; }
  [[nodiscard]] std::int64_t largest_step_back_ns() const { return largest_step_back_ns_; }
  /// Median of the steps from message to message; nothing below two messages.
  [[nodiscard]] std::optional<std::int64_t> MedianStep() const;
  /// The median step, or the mean where messages come in bursts: where it is above four medians.
  [[nodiscard]] std::optional<std::int64_t> TypicalStep() const;
  /// How much the steps differ: from the 5 % to the 95 % quantile, over the median.
  [[nodiscard]] std::optional<double> Irregularity() const;

 private:
  std::uint64_t count_ = 0, num_back_ = 0;
  std::int64_t first_ns_ = 0, last_ns_ = 0, largest_ns_ = 0, largest_step_back_ns_ = 0;
  Reservoir steps_;
};

/// One of the clocks that a message may go by, and how it behaves.
struct ClockEvidence {
  ClockChoice clock = ClockChoice::kReceive;
  std::uint64_t count = 0, num_back = 0;
  std::optional<double> step_s = std::nullopt;        // median
  std::optional<double> irregularity = std::nullopt;  // see ClockStatistics
};

/// The clock to go by, as `told`, or the most regular one: of those that go back in less than 1 %
/// of the messages; of equals the header before the counter before the time of recording. Nothing
/// if there is none of that kind.
[[nodiscard]] std::optional<ClockChoice> ChooseClock(ClockChoice told,
                                                     const std::vector<ClockEvidence>& evidence);

/// "header (steps of 10.0 ms, irregularity 0.08; receive: steps of 9.9 ms, irregularity 3.1)".
[[nodiscard]] std::string DescribeClocks(ClockChoice chosen,
                                         const std::vector<ClockEvidence>& evidence);

}  // namespace scoria::logs
