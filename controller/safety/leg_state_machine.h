// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/config/archive.h"
#include "core/robot/plans.h"

namespace scoria::controller {

/// What happens to a foot that has not touched the ground when its stance is due.
enum class LateContact { kStance, kLower };
constexpr std::array<std::pair<LateContact, std::string_view>, 2> EnumNames(LateContact) {
  return {{{LateContact::kStance, "stance"}, {LateContact::kLower, "lower"}}};
}

struct LegStateParams {
  bool early_contact = true;
  double early_contact_after = 0.5;
  LateContact late_contact = LateContact::kStance;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("early_contact", early_contact, {.doc = "a swing foot that touches becomes stance"});
    a.Field("early_contact_after", early_contact_after,
            {.min = 0.0, .max = 1.0, .doc = "swing progress from which touching counts"});
    a.Field("late_contact", late_contact,
            {.doc = "stance: treated as stance at once; lower: lowered until it touches"});
  }
};

/// Corrects the planned contacts by the felt ones. Transitions:
///   swing  -> early contact   planned swing, touching, progress beyond early_contact_after
///   swing  -> stance          planned stance, touching or late_contact: stance
///   swing  -> late contact    planned stance, not touching, late_contact: lower
///   late   -> stance          touching;      late -> swing   planned swing
///   early  -> stance          planned stance
///   stance -> swing           planned swing
class LegStateMachine {
 public:
  explicit LegStateMachine(const LegStateParams& params) noexcept : params_(params) {}

  /// @param age_s time since `plan` was made. @param dt_s time since the last call.
  [[nodiscard]] const LegPhases& Update(const ContactPlan& plan, const LegArray<bool>& contact,
                                        double age_s, double dt_s) noexcept;

  /// Early contacts since the start.
  [[nodiscard]] std::uint32_t early_contacts() const noexcept { return early_contacts_; }

 private:
  [[nodiscard]] LegMode Next(LegMode mode, bool planned_stance, bool touching,
                             double progress) const noexcept;

  LegStateParams params_;
  LegPhases legs_;
  std::uint32_t early_contacts_ = 0;
};

}  // namespace scoria::controller
