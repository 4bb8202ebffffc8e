// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "analysis/statistics/histogram.h"

namespace scoria::analysis {

/// Delays on the grid of the rows, negative when early; beyond ±0.25 s they count at the end.
class DelayHistogram {
 public:
  static constexpr double kBin_s = 0.002;
  static constexpr std::size_t kBins = 251, kMiddle = kBins / 2;

  void Add(double delay_s) noexcept;
  /// @param share in [0, 1]. @returns 0 without delays.
  [[nodiscard]] double Quantile(double share) const noexcept;
  [[nodiscard]] std::uint64_t count() const noexcept { return bins.Total(); }
  DelayHistogram& operator+=(const DelayHistogram& other) noexcept;
  bool operator==(const DelayHistogram&) const = default;

  BinCounts<kBins> bins;
};

/// How one kind of edge, touchdown or lift-off, was reported.
struct EdgeQuality {
  DelayHistogram delays;  // reported minus true
  std::uint64_t missed = 0, false_alarms = 0;
  [[nodiscard]] std::uint64_t true_edges() const noexcept { return delays.count() + missed; }
  EdgeQuality& operator+=(const EdgeQuality& other) noexcept;
  bool operator==(const EdgeQuality&) const = default;
};

/// Matches a source's edges with the true ones, one leg and one kind of edge. Written for
/// touchdowns; lift-offs are the touchdowns of the inverted signals.
///   touchdown seen:  the source says contact at the true touchdown, since a moment in this swing
///                    (early), or begins to say so before the foot lifts off (late)
///   missed:          neither
///   false:           the source says contact and ends it within one true swing, unless the
///                    foot truly touched within 15 ms of it
class EdgeMatcher {
 public:
  struct Instant {
    double time_s = 0.0;
    bool on = false;       // truth, without runs below 10 ms
    bool near_on = false;  // truth with them, anywhere within 15 ms
    bool reported = false;
  };
  void Update(const Instant& now, EdgeQuality& quality) noexcept;
  void Reset() noexcept { *this = {}; }

 private:
  bool started_ = false, on_ = false, reported_ = false;
  bool swing_seen_ = false;  // from its beginning
  bool rose_ = false;        // in this swing
  bool rose_near_ = false;   // the foot's true touch
  bool waiting_ = false;     // for the report, since the true touchdown
  double rise_s_ = 0.0, touchdown_s_ = 0.0;
};

}  // namespace scoria::analysis
