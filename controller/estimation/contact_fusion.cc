// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/contact_fusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::controller {
namespace {

double NormalCdf(double x) noexcept { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double Square(double x) noexcept { return x * x; }

}  // namespace

double CalcPhaseProbability(double phase, double duty, double sigma) noexcept {
  if (duty >= 1.0) return 1.0;
  double p = 0.0;
  for (const double turn : {-1.0, 0.0, 1.0}) {
    p += NormalCdf((phase + turn) / sigma) - NormalCdf((phase + turn - duty) / sigma);
  }
  return std::clamp(p, 0.0, 1.0);
}

double CalcContactProbability(const FusionParams& params, const FusionInput& in) noexcept {
  const double by_phase =
      CalcPhaseProbability(in.phase, in.duty, params.phase_sigma_s / in.period_s);
  const double by_force = NormalCdf((in.force - params.force_mean) / params.force_sigma);
  const double by_height = NormalCdf((params.height_mean_m - in.height_m) / params.height_sigma_m);
  const double w_phase = 1.0 / Square(params.phase_deviation);
  const double w_force = 1.0 / Square(params.force_deviation);
  const double w_height = 1.0 / Square(params.height_deviation);
  return (w_phase * by_phase + w_force * by_force + w_height * by_height) /
         (w_phase + w_force + w_height);
}

bool DecideContact(const FusionParams& params, double probability, bool before) noexcept {
  return probability > (before ? 0.5 - params.hysteresis : 0.5 + params.hysteresis);
}

PlannedPhase AdvancePhase(const ContactPlan& plan, Leg leg, double age_s) noexcept {
  if (plan.standing || plan.duty[leg] >= 1.0) return {};
  const double phase = plan.phase[leg] + age_s / plan.period_s;
  return {phase - std::floor(phase), plan.duty[leg]};
}

}  // namespace scoria::controller
