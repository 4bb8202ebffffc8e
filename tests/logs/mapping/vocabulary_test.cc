// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/vocabulary.h"

#include <gtest/gtest.h>

namespace scoria::logs {
namespace {

TEST(Vocabulary, KnowsWhatLegsAreCalled) {
  const std::array<std::vector<std::string>, 4> names = {{
      {"FL", "lf", "front_left", "Left Front", "FL_foot", "frontLeft"},
      {"FR", "rf", "front-right", "rightFront", "foot.fr"},
      {"HL", "RL", "bl", "LH", "rear_left", "hind left", "BackLeft"},
      {"HR", "RR", "br", "rh", "rear_right", "right_hind"},
  }};
  for (const Leg leg : kLegs) {
    for (const std::string& name : names[static_cast<std::size_t>(leg)])
      EXPECT_EQ(LegNamed(name), leg) << name;
  }
  for (const char* none : {"", "left", "front", "leg0", "world", "flag"})
    EXPECT_EQ(LegNamed(none), std::nullopt) << none;
}

std::vector<std::optional<JointName>> Named(const std::vector<std::string>& names) {
  return JointsNamed(names);
}

TEST(Vocabulary, KnowsWhatJointsAreCalled) {
  const JointName haa{Leg::kHR, Joint::kHAA}, hfe{Leg::kHR, Joint::kHFE},
      kfe{Leg::kHR, Joint::kKFE};
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"RR_hip_joint", "RR_thigh_joint", "RR_calf_joint"},
        {"RH_HAA", "RH_HFE", "RH_KFE"},
        {"br_abad", "br_shoulder", "br_knee"},
        {"hr.hx", "hr.hy", "hr.kn"},
        {"q_RR_abad", "q_RR_hip", "q_RR_knee"},
        {"rh_hip_joint", "rh_upper_leg_joint", "rh_lower_leg_joint"}}) {
    EXPECT_EQ(Named(names), (std::vector<std::optional<JointName>>{haa, hfe, kfe})) << names[0];
  }
  EXPECT_EQ(Named({"arm_shoulder", "fl_wheel"}),
            (std::vector<std::optional<JointName>>{std::nullopt, std::nullopt}));
}

}  // namespace
}  // namespace scoria::logs
