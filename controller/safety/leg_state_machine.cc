// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/leg_state_machine.h"

#include <algorithm>

namespace scoria::controller {
namespace {

LegMode InTheAir(AirborneFoot choice) noexcept {
  switch (choice) {
    case AirborneFoot::kLower:
      return LegMode::kLowering;
    case AirborneFoot::kHold:
      return LegMode::kHolding;
    case AirborneFoot::kStance:
      break;
  }
  return LegMode::kStance;
}

bool IsSwing(LegMode mode) noexcept { return mode == LegMode::kSwing || mode == LegMode::kStumble; }

bool IsWaiting(LegMode mode) noexcept {
  return mode == LegMode::kLowering || mode == LegMode::kHolding;
}

}  // namespace

LegMode LegStateMachine::Next(LegMode mode, bool planned_stance,
                              const Sensed& sensed) const noexcept {
  if (planned_stance) {
    if (IsSwing(mode) && !sensed.touching) return InTheAir(params_.late_contact);
    if (IsWaiting(mode) && !sensed.touching) return mode;
    if (mode == LegMode::kStance && sensed.lost) return InTheAir(params_.lost_contact);
    return LegMode::kStance;
  }
  if (mode == LegMode::kEarlyContact) return mode;
  if (!IsSwing(mode)) return LegMode::kSwing;
  if (params_.early_contact && sensed.touching && sensed.progress > params_.early_contact_after)
    return LegMode::kEarlyContact;
  if (params_.stumble_reflex && sensed.touching && sensed.progress > params_.stumble_after)
    return LegMode::kStumble;
  return mode;
}

const LegPhases& LegStateMachine::Update(const ContactPlan& plan, const LegArray<bool>& contact,
                                         double age_s, double dt_s, Counters& counters) noexcept {
  for (const Leg leg : kLegs) {
    double progress = legs_.swing_progress[leg];
    if (!plan.stance[leg]) {
      const double remaining_s = std::max(0.0, plan.swing_remaining_s[leg] - age_s);
      progress = 1.0 - remaining_s / plan.swing_s[leg];
      legs_.swing_s[leg] = plan.swing_s[leg];
    }
    legs_.swing_progress[leg] = progress;
    const LegMode before = legs_.mode[leg];
    const bool touching = contact[leg], stood = before == LegMode::kStance;
    has_touched_[leg] = stood && (has_touched_[leg] || touching);
    const double untouched_s = untouched_s_[leg];
    untouched_s_[leg] = stood && !touching ? untouched_s + dt_s : 0.0;
    const bool lost = has_touched_[leg] && untouched_s_[leg] > params_.lost_after_s;
    const LegMode mode = Next(before, plan.stance[leg], {touching, lost, progress});
    if (mode != before && mode == LegMode::kEarlyContact) counters.Add(Count::kEarlyContact);
    if (mode != before && mode == LegMode::kStumble) counters.Add(Count::kStumble);
    if (plan.stance[leg] && IsSwing(before) && !touching) counters.Add(Count::kLateContact);
    if (plan.stance[leg] && lost && untouched_s <= params_.lost_after_s)
      counters.Add(Count::kLostContact);
    legs_.late_s[leg] = IsWaiting(mode) ? legs_.late_s[leg] + dt_s : 0.0;
    legs_.mode[leg] = mode;
    if (mode == LegMode::kStance) legs_.swing_progress[leg] = 0.0;
  }
  return legs_;
}

}  // namespace scoria::controller
