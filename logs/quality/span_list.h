// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "logs/quality/finding.h"

namespace scoria::logs {

/// The longest of the spans that are added, in the order of time, and how many there were.
class SpanList {
 public:
  void Add(const TimeSpan& span) {
    ++count_;
    total_s_ += span.end_s - span.begin_s;
    spans_.push_back(span);
    if (spans_.size() <= kMostSpans) return;
    spans_.erase(std::min_element(spans_.begin(), spans_.end(), IsShorter));
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  [[nodiscard]] double total_s() const noexcept { return total_s_; }
  [[nodiscard]] const std::vector<TimeSpan>& spans() const noexcept { return spans_; }
  /// @pre count() > 0.
  [[nodiscard]] TimeSpan longest() const {
    return *std::max_element(spans_.begin(), spans_.end(), IsShorter);
  }

 private:
  static bool IsShorter(const TimeSpan& a, const TimeSpan& b) {
    return std::abs(a.end_s - a.begin_s) < std::abs(b.end_s - b.begin_s);
  }
  std::vector<TimeSpan> spans_;
  std::uint64_t count_ = 0;
  double total_s_ = 0.0;
};

}  // namespace scoria::logs
