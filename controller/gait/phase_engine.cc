// SPDX-License-Identifier: BSD-3-Clause
#include "controller/gait/phase_engine.h"

#include <algorithm>
#include <cmath>

namespace scoria::controller {
namespace {

constexpr double kCorrectionCycles = 2.0;  // an offset error of 0.5 is corrected within two cycles

double Fraction(double x) noexcept { return x - std::floor(x); }

}  // namespace

/// All feet are down: put the first legs of the pattern just before lift-off and the others behind
/// by their offsets.
void PhaseEngine::StartWalking() noexcept {
  const double reference = timing_.duty - 1e-9;
  for (const Leg leg : kLegs) {
    phase_[leg] = Fraction(reference + timing_.offset[Leg::kFL] - timing_.offset[leg]);
    // A leg that the pattern has in the air starts its stance instead; the offset correction brings
    // it into step.
    if (phase_[leg] >= timing_.duty) phase_[leg] = 0.0;
  }
  standing_ = false;
}

/// The leg whose phase the others follow: the swing leg with the longest remaining swing, else the
/// one nearest lift-off.
Leg PhaseEngine::ReferenceLeg() const noexcept {
  Leg best = Leg::kFL;
  double best_score = -1.0;
  for (const Leg leg : kLegs) {
    const bool swing = !InStance(leg);
    const double score = swing ? 2.0 - phase_[leg] : phase_[leg];  // swing scores lie in (1, 2]
    if (score > best_score) {
      best_score = score;
      best = leg;
    }
  }
  return best;
}

void PhaseEngine::CorrectOffsets(double dt_s) noexcept {
  const Leg reference = ReferenceLeg();
  const double limit = dt_s / (kCorrectionCycles * timing_.period_s);
  for (const Leg leg : kLegs) {
    if (leg == reference || phase_[leg] >= timing_.duty - limit) continue;
    const double offset = phase_[reference] + timing_.offset[reference] - phase_[leg];
    const double error = Fraction(offset - timing_.offset[leg] + 0.5) - 0.5;
    phase_[leg] =
        std::clamp(phase_[leg] + std::clamp(error, -limit, limit), 0.0, timing_.duty - limit);
  }
}

void PhaseEngine::Update(const GaitTiming& timing, double dt_s, bool walking,
                         const LegArray<bool>& touched_down) noexcept {
  const double old_duty = timing_.duty;
  walking_ = walking;
  timing_ = timing;
  if (standing_) {
    phase_ = LegArray<double>(0.0);
    if (!walking) return;
    StartWalking();
    return;
  }
  bool all_down = true;
  for (const Leg leg : kLegs) {
    double& phase = phase_[leg];
    const bool was_stance = phase < old_duty;
    // Keep the share of the stance or swing that is done when the duty factor changes, then move
    // on.
    double next = was_stance
                      ? phase * timing_.duty / old_duty
                      : (phase - old_duty) * (1.0 - timing_.duty) / (1.0 - old_duty) + timing_.duty;
    if (walking || !was_stance) next += dt_s / timing_.period_s;
    if (next >= 1.0) next = std::min(next - 1.0, 0.5 * timing_.duty);
    if (touched_down[leg] && next >= timing_.duty) next = 0.0;
    phase = next;
    all_down = all_down && phase < timing_.duty;
  }
  if (walking) {
    CorrectOffsets(dt_s);
  } else {
    standing_ = all_down;
  }
}

void PhaseEngine::Step(Leg leg, const GaitTiming& timing) noexcept {
  timing_ = timing;
  phase_ = LegArray<double>(0.0);
  phase_[leg] = timing.duty;
  standing_ = walking_ = false;
}

ContactPlan PhaseEngine::Predict(int horizon, double stage_s) const noexcept {
  ContactPlan plan;
  plan.horizon = horizon;
  plan.dt_s = stage_s;
  plan.standing = standing_;
  plan.period_s = timing_.period_s;
  plan.offset = timing_.offset;
  for (const Leg leg : kLegs) {
    plan.duty[leg] = standing_ ? 1.0 : timing_.duty;
    plan.phase[leg] = phase_[leg];
    plan.stance[leg] = standing_ || InStance(leg);
    plan.stance_s[leg] = timing_.duty * timing_.period_s;
    plan.swing_s[leg] = (1.0 - timing_.duty) * timing_.period_s;
    plan.swing_remaining_s[leg] = plan.stance[leg] ? 0.0 : (1.0 - phase_[leg]) * timing_.period_s;
    for (int k = 0; k < horizon; ++k) {
      const double ahead = phase_[leg] + k * stage_s / timing_.period_s;
      // While stopping, a foot that is down stays down.
      const bool stays = !walking_ && (plan.stance[leg] || ahead >= 1.0);
      plan.stage_stance[static_cast<std::size_t>(k)][leg] =
          standing_ || stays || Fraction(ahead) < timing_.duty;
    }
  }
  return plan;
}

}  // namespace scoria::controller
