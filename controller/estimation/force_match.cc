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
  const bool tells_gain = in.raw_counts < params_.saturated_counts && zero_counts_.time_s > 0.0;
  if (!in.on_ground || !tells_gain) return;
  ground_counts_.Add(in.raw_counts - zero_counts_.value, step_s_, params_.learn_s);
  ground_force_N_.Add(in.force_N, step_s_, params_.learn_s);
}

/// @returns the force by the counts less the observer's; 0 until zero and gain are known.
double ForceMatch::CalcDifference_N(const ForceMatchInput& in) const noexcept {
  const bool learned =
      zero_counts_.time_s >= params_.learn_s && ground_counts_.time_s >= params_.learn_s;
  // Without a positive gain the counts have never told ground from air.
  if (!learned || ground_counts_.value <= 0.0 || ground_force_N_.value <= 0.0) return 0.0;
  const double N_per_count = ground_force_N_.value / ground_counts_.value;
  const double difference_N = N_per_count * (in.raw_counts - zero_counts_.value) - in.force_N;
  return in.raw_counts >= params_.saturated_counts ? std::max(0.0, difference_N) : difference_N;
}

bool ForceMatch::Update(const ForceMatchInput& in) noexcept {
  if (in.in_air || in.on_ground) {
    const double difference_N = std::clamp(CalcDifference_N(in), -params_.cap_N, params_.cap_N);
    const double tolerance_N =
        params_.tolerance_N + params_.tolerance_share * std::max(0.0, in.force_N);
    const auto add = [&](double impulse_Ns, double beyond_N) {
      return std::clamp(impulse_Ns + beyond_N * step_s_, 0.0, params_.impulse_Ns);
    };
    more_Ns_ = add(more_Ns_, difference_N - tolerance_N);
    less_Ns_ = add(less_Ns_, -difference_N - tolerance_N);
    if (in.learn) Learn(in);
  }
  return std::max(more_Ns_, less_Ns_) < params_.impulse_Ns;
}

}  // namespace scoria::controller
