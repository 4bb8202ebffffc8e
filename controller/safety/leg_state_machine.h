// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/config/field.h"
#include "core/robot/counters.h"
#include "core/robot/plans.h"

namespace scoria::controller {

/// What a foot in the air does when it ought to stand.
enum class AirborneFoot { kStance, kLower, kHold };
constexpr std::array<std::pair<AirborneFoot, std::string_view>, 3> EnumNames(AirborneFoot) {
  return {{{AirborneFoot::kStance, "stance"},
           {AirborneFoot::kLower, "lower"},
           {AirborneFoot::kHold, "hold"}}};
}

struct LegStateParams {
  bool early_contact = true;
  double early_contact_after = 0.5;
  AirborneFoot late_contact = AirborneFoot::kStance;
  AirborneFoot lost_contact = AirborneFoot::kStance;
  double lost_after_s = 0.02;
  bool stumble_reflex = false;
  double stumble_after = 0.15;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("early_contact", early_contact, {.doc = "a swing foot that touches becomes stance"});
    a.Field("early_contact_after", early_contact_after,
            {.min = 0.0, .max = 1.0, .doc = "swing progress from which touching counts"});
    a.Field("late_contact", late_contact,
            {.doc = "a foot that has not touched when its stance is due. stance: treated as stance "
                    "at once; lower: lowered until it touches; hold: held in the body frame"});
    a.Field("lost_contact", lost_contact,
            {.doc = "a foot that loses the ground during its stance, likewise"});
    a.Field("lost_after_s", lost_after_s,
            {.min = 0.0,
             .max = 1.0,
             .doc = "in the air, before the contact counts as lost",
             .scale = core::dimension::kTime});
    a.Field(
        "stumble_reflex", stumble_reflex,
        {.doc = "a swing foot that hits something before early_contact_after is lifted over it"});
    a.Field("stumble_after", stumble_after,
            {.min = 0.0, .max = 1.0, .doc = "swing progress from which touching is a stumble"});
  }
  bool operator==(const LegStateParams&) const = default;
};

/// Corrects the planned contacts by the sensed ones. `air` below is kLowering or kHolding as
/// late_contact says, or kStance if it says so; likewise for a foot whose contact is lost.
///   from            planned  sensed                               to
///   swing, stumble  stance   touching                             stance
///   swing, stumble  stance   in the air                           air
///   swing           swing    touching, beyond early_contact_after early contact
///   stumble         swing    the same                             early contact
///   swing           swing    touching, beyond stumble_after       stumble
///   early contact   swing    anything                             early contact
///   early contact   stance   anything                             stance
///   lowering, hold  stance   touching                             stance
///   stance          stance   lost for lost_after_s, once touched  air
///   any other       swing    anything                             swing
class LegStateMachine {
 public:
  explicit LegStateMachine(const LegStateParams& params) noexcept : params_(params) {}

  /// @param age_s time since `plan` was made. @param dt_s time since the last call.
  [[nodiscard]] const LegPhases& Update(const ContactPlan& plan, const LegArray<bool>& contact,
                                        double age_s, double dt_s, Counters& counters) noexcept;

  void set_params(const LegStateParams& params) noexcept { params_ = params; }

 private:
  struct Sensed {
    bool touching, lost;
    double progress;
  };
  [[nodiscard]] LegMode Next(LegMode mode, bool planned_stance,
                             const Sensed& sensed) const noexcept;

  LegStateParams params_;
  LegPhases legs_;
  LegArray<bool> has_touched_;    // in this stance
  LegArray<double> untouched_s_;  // how long a stance foot has been off the ground
};

}  // namespace scoria::controller
