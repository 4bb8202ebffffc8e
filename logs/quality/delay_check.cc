// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/delay_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/math/so3.h"

namespace scoria::logs {
namespace {

/// A delay has to explain so much of the difference that no more than this share of it is left.
constexpr double kMostLeft = 0.7;

/// Where a parabola through three values has its lowest point, from the middle one on.
double LowestPoint(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature > 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

}  // namespace

void DelayCheck::AddTick(const Tick& tick) {
  last_.Add(tick);
  if (!last_.IsFull()) return;
  std::array<Vec3, kNumLags> rates;  // by the gyroscope, at each delay
  for (std::size_t lag = 0; lag < kNumLags; ++lag) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = lag; i <= lag + 2 * kHalf; ++i) {
      if (!last_[i].w_WB_B) return;
      sum += (i == lag || i == lag + 2 * kHalf ? 0.5 : 1.0) * *last_[i].w_WB_B;
    }
    rates[lag] = sum / (2.0 * kHalf);
  }
  rate_squares_.Add(rates[kLags].squaredNorm());
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    const auto &before = last_[kLags].R_WB[s], &after = last_[kLags + 2 * kHalf].R_WB[s];
    if (!before || !after) continue;
    const Vec3 rate = core::LogSo3(before->transpose() * *after) / (2.0 * kHalf * kTick_s);
    const double now = (rates[kLags] - rate).squaredNorm();
    for (std::size_t i = 0; i < kNumLags; ++i) {
      const double squares = (rates[i] - rate).squaredNorm();
      banks_[s].squares[i] += squares;
      banks_[s].gain[i].Add(now - squares);
    }
  }
}

std::vector<Finding> DelayCheck::JudgeSource(std::size_t source) const {
  const Bank& bank = banks_[source];
  if (bank.gain[0].count() < 6 * BlockMean::kBlock) return {};
  const auto best = static_cast<std::size_t>(
      std::min_element(bank.squares.begin(), bank.squares.end()) - bank.squares.begin());
  const SignalId signal = kAttitudeSignals[source];
  const double n = static_cast<double>(bank.gain[0].count());
  const double left = bank.squares[best] / n, now = bank.squares[kLags] / n;
  const auto not_judged = [&](const char* why) {
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, signal);
    f.spoils.reset();
    f.evidence = fmt::format("delay against imu.rate: {}", why);
    return std::vector{f};
  };
  if (rate_squares_.mean() < 0.05 * 0.05) return not_judged("not enough motion to tell");
  // A difference that delays explain leaves little; other errors of either leave much.
  if (best == kLags) return {};
  if (best == 0 || best == kNumLags - 1 || left > kMostLeft * now ||
      bank.gain[best].t() < kSureAbove_t)
    return left > 0.5 * rate_squares_.mean() ? not_judged("no delay makes them agree")
                                             : std::vector<Finding>();
  const double delay_s =
      kTick_s * (static_cast<double>(best) - kLags +
                 LowestPoint(bank.squares[best - 1], bank.squares[best], bank.squares[best + 1]));
  if (std::abs(delay_s) < kWarning_s) return {};
  const bool is_imu = delay_s > 0.0;
  Finding f = MakeFinding(std::abs(delay_s) < kError_s ? Severity::kWarning : Severity::kError,
                          is_imu ? FindingKind::kImuDelay : FindingKind::kAttitudeDelay,
                          is_imu ? SignalId::kImuRate : signal);
  f.size = std::abs(delay_s);
  f.evidence = fmt::format(
      "{} is {:.1f} ms later than {}: shifted by it their difference is {:.3f} rad/s rms, without "
      "{:.3f} rad/s",
      f.signal, 1e3 * *f.size, TraitsOf(is_imu ? signal : SignalId::kImuRate).key, std::sqrt(left),
      std::sqrt(now));
  f.repair = "mapping: a clock that both share (time.stamp)";
  return {f};
}

std::vector<Finding> DelayCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (HasError(earlier, {FindingKind::kDegrees, FindingKind::kQuaternionOrder,
                         FindingKind::kRollPitchSwapped, FindingKind::kAttitudeSign}))
    return {};
  std::vector<Finding> findings;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    for (const Finding& f : JudgeSource(s)) findings.push_back(f);
  }
  return findings;
}

}  // namespace scoria::logs
