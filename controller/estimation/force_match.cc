// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/force_match.h"

#include <algorithm>

namespace scoria::controller {

void ForceMatch::Mean::Add(double sample, double step_s, double constant_s) noexcept {
  time_s = std::min(time_s + step_s, constant_s);
  value += (sample - value) * step_s / time_s;
}

void ForceMatch::Learn(const ForceMatchInput& in) noexcept {
  if (in.in_air) zero_counts_.Add(in.raw_counts, step_s_, params_.zero_s);
  if (!in.on_ground || zero_counts_.time_s == 0.0) return;
  ground_counts_.Add(in.raw_counts - zero_counts_.value, step_s_, params_.gain_s);
  ground_force_N_.Add(in.force_N, step_s_, params_.gain_s);
}

bool ForceMatch::CanJudge(const ForceMatchInput& in) const noexcept {
  const bool learned =
      zero_counts_.time_s >= params_.zero_s && ground_counts_.time_s >= params_.zero_s;
  // Without a positive gain the counts have never told ground from air.
  if (!learned || ground_counts_.value <= 0.0 || ground_force_N_.value <= 0.0) return false;
  return in.in_air || (in.on_ground && in.force_N <= params_.load_share * ground_force_N_.value);
}

bool ForceMatch::Update(const ForceMatchInput& in) noexcept {
  if (CanJudge(in)) {
    const double N_per_count = ground_force_N_.value / ground_counts_.value;
    const double f_N = std::max(0.0, in.force_N);  // the ground does not pull
    const double excess_N = N_per_count * (in.raw_counts - zero_counts_.value) - f_N;
    const double beyond_N =
        std::min(excess_N, params_.cap_N) - (params_.tolerance_N + params_.tolerance_share * f_N);
    excess_Ns_ = std::clamp(excess_Ns_ + beyond_N * step_s_, 0.0, params_.impulse_Ns);
  }
  if (in.learn) Learn(in);
  return excess_Ns_ < params_.impulse_Ns;
}

}  // namespace scoria::controller
