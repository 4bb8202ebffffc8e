// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/contact_edges.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {

void DelayHistogram::Add(double delay_s) noexcept {
  const double bin = std::clamp(std::round(delay_s / kBin_s) + static_cast<double>(kMiddle), 0.0,
                                static_cast<double>(kBins - 1));
  ++bins.counts[static_cast<std::size_t>(bin)];
}

double DelayHistogram::Quantile(double share) const noexcept {
  const std::uint64_t total = count();
  if (total == 0) return 0.0;
  const auto rank = static_cast<std::uint64_t>(share * static_cast<double>(total - 1));
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (below + bins.counts[bin] <= rank) below += bins.counts[bin++];
  return (static_cast<double>(bin) - static_cast<double>(kMiddle)) * kBin_s;
}

DelayHistogram& DelayHistogram::operator+=(const DelayHistogram& other) noexcept {
  bins += other.bins;
  return *this;
}

EdgeQuality& EdgeQuality::operator+=(const EdgeQuality& other) noexcept {
  delays += other.delays;
  missed += other.missed;
  false_alarms += other.false_alarms;
  return *this;
}

void EdgeMatcher::Update(const Instant& now, EdgeQuality& quality) noexcept {
  const bool rises = started_ && now.reported && !reported_;
  const bool falls = started_ && !now.reported && reported_;
  const bool touches = started_ && now.on && !on_;
  const bool lifts = started_ && !now.on && on_;
  if (lifts) {
    if (waiting_) ++quality.missed;
    waiting_ = rose_ = false;
    swing_seen_ = true;
  }
  if (rises) {
    rose_ = true;
    rose_near_ = now.near_on;
    rise_s_ = now.time_s;
    if (waiting_) quality.delays.Add(now.time_s - touchdown_s_);
    waiting_ = false;
  }
  if (touches) {
    touchdown_s_ = now.time_s;
    waiting_ = !now.reported;
    if (now.reported && rose_) {
      quality.delays.Add(rise_s_ - now.time_s);
    } else if (now.reported && swing_seen_) {
      ++quality.missed;  // it never noticed the swing
    }
  }
  if (falls && !now.on && rose_) {
    if (!rose_near_) ++quality.false_alarms;
    rose_ = false;
  }
  started_ = true;
  on_ = now.on;
  reported_ = now.reported;
}

}  // namespace scoria::analysis
