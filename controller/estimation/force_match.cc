// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/force_match.h"

#include <algorithm>

namespace scoria::controller {

void ForceMatch::Mean::Add(double sample, double step_s, double constant_s) noexcept {
  time_s = std::min(time_s + step_s, constant_s);
  value += (sample - value) * step_s / time_s;
}

void ForceMatch::Learn(const ForceMatchInput& in) noexcept {
  if (in.in_air) zero_counts_.Add(in.raw_counts, step_s_, params_.learn_s);
  if (!in.on_ground || zero_counts_.time_s == 0.0) return;
  ground_counts_.Add(in.raw_counts - zero_counts_.value, step_s_, params_.learn_s);
  ground_force_N_.Add(in.force_N, step_s_, params_.learn_s);
}

/// @returns the force by the counts less the observer's; 0 until zero and gain are known.
double ForceMatch::CalcExcess_N(const ForceMatchInput& in) const noexcept {
  const bool learned =
      zero_counts_.time_s >= params_.learn_s && ground_counts_.time_s >= params_.learn_s;
  // Without a positive gain the counts have never told ground from air.
  if (!learned || ground_counts_.value <= 0.0 || ground_force_N_.value <= 0.0) return 0.0;
  const double N_per_count = ground_force_N_.value / ground_counts_.value;
  return N_per_count * (in.raw_counts - zero_counts_.value) - in.force_N;
}

bool ForceMatch::Update(const ForceMatchInput& in) noexcept {
  if (in.in_air || in.on_ground) {
    const double tolerance_N =
        params_.tolerance_N + params_.tolerance_share * std::max(0.0, in.force_N);
    const double beyond_N = std::min(CalcExcess_N(in), params_.cap_N) - tolerance_N;
    excess_Ns_ = std::clamp(excess_Ns_ + beyond_N * step_s_, 0.0, params_.impulse_Ns);
    if (in.learn) Learn(in);
  }
  return excess_Ns_ < params_.impulse_Ns;
}

}  // namespace scoria::controller
