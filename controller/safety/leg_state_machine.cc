// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/leg_state_machine.h"

#include <algorithm>

namespace scoria::controller {

LegMode LegStateMachine::Next(LegMode mode, bool planned_stance, bool touching,
                              double progress) const noexcept {
  if (planned_stance) {
    const bool airborne = mode == LegMode::kSwing || mode == LegMode::kLateContact;
    const bool wait = airborne && !touching && params_.late_contact == LateContact::kLower;
    return wait ? LegMode::kLateContact : LegMode::kStance;
  }
  if (mode == LegMode::kEarlyContact) return LegMode::kEarlyContact;
  const bool swinging = mode == LegMode::kSwing;
  if (params_.early_contact && swinging && touching && progress > params_.early_contact_after) {
    return LegMode::kEarlyContact;
  }
  return LegMode::kSwing;
}

const LegPhases& LegStateMachine::Update(const ContactPlan& plan, const LegArray<bool>& contact,
                                         double age_s, double dt_s) noexcept {
  for (const Leg leg : kLegs) {
    double progress = legs_.swing_progress[leg];
    if (!plan.stance[leg]) {
      const double remaining_s = std::max(0.0, plan.swing_remaining_s[leg] - age_s);
      progress = 1.0 - remaining_s / plan.swing_s[leg];
      legs_.swing_s[leg] = plan.swing_s[leg];
    }
    legs_.swing_progress[leg] = progress;
    const LegMode mode = Next(legs_.mode[leg], plan.stance[leg], contact[leg], progress);
    if (mode == LegMode::kEarlyContact && legs_.mode[leg] != mode) ++early_contacts_;
    legs_.late_s[leg] = mode == LegMode::kLateContact ? legs_.late_s[leg] + dt_s : 0.0;
    legs_.mode[leg] = mode;
    if (mode == LegMode::kStance) legs_.swing_progress[leg] = 0.0;
  }
  return legs_;
}

}  // namespace scoria::controller
