// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/verdict.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/run/robot_warnings.h"
#include "core/robot_files/load.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

WalkConditions Conditions() { return ConditionsOf(Scenario{}, test::Go2()); }

/// The Go2 after a change.
core::RobotDescription Changed(const std::function<void(core::RobotDescription&)>& change) {
  core::RobotDescription robot = test::Go2();
  change(robot);
  return robot;
}

WalkFinding Find(const core::RobotDescription& robot, WalkTopic topic,
                 const WalkConditions& conditions = Conditions()) {
  return JudgeRobot(robot, conditions).at(static_cast<std::size_t>(topic));
}

void ForEachJoint(core::RobotDescription& robot,
                  const std::function<void(core::JointDescription&)>& change) {
  for (core::LegDescription& leg : robot.legs) {
    for (core::JointDescription& joint : leg.joints) change(joint);
  }
}

TEST(Verdict, Go2HasAllThatWalkingNeeds) {
  const auto findings = JudgeRobot(test::Go2(), Conditions());
  ASSERT_EQ(findings.size(), 5u);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    EXPECT_EQ(findings[i].topic, static_cast<WalkTopic>(i));
    EXPECT_EQ(findings[i].grade, WalkGrade::kMet) << findings[i].text;
  }
  EXPECT_EQ(Verdict(findings), "nothing in these files keeps it from walking");
  EXPECT_TRUE(WalkWarnings(test::Go2(), Conditions()).empty());
}

// Half the weight on the foot of a massless leg: 441.5 N.
TEST(Verdict, TorqueOfAStandingLegIsStatics) {
  core::RobotDescription robot = Changed([](core::RobotDescription& r) {
    r.trunk.mass_kg = 90.0;
    for (core::LegDescription& leg : r.legs) {
      for (core::Body& link : leg.links) link.mass_kg = 1e-6;
    }
  });
  const WalkFinding finding = Find(robot, WalkTopic::kTorque);
  EXPECT_EQ(finding.grade, WalkGrade::kNotMet);
  // The foot stands 0.150 - 0.0465 m beside the axis of HAA.
  EXPECT_EQ(
      finding.text,
      "standing on two legs, FL_hip_joint needs 45.7 of 23.7 Nm; it cannot carry itself: less "
      "mass, a nominal_height_m nearer to straight legs, or the drive's own "
      "limits.haa.effort_Nm");
  EXPECT_EQ(Verdict(JudgeRobot(robot, Conditions())), "cannot walk as it is: torque, force");
  WalkConditions moon = Conditions();
  moon.gravity_mps2 = 1.62;
  EXPECT_EQ(Find(robot, WalkTopic::kTorque, moon).grade, WalkGrade::kMet);
  // Thigh and shank of 0.213 m, the foot 0.3 m below: the knee stands 0.151 m behind the foot.
  for (core::LegDescription& leg : robot.legs) leg.joints[0].effort_Nm = 1000.0;
  const std::string knee = Find(robot, WalkTopic::kTorque).text;
  EXPECT_NE(knee.find("_calf_joint needs "), std::string::npos) << knee;
  EXPECT_NEAR(std::stod(knee.substr(knee.find("needs ") + 6)), 441.5 * 0.151, 1.5) << knee;
}

TEST(Verdict, SlowJointsAreToldHowFastTheyMayWalk) {
  const core::RobotDescription robot = Changed([](core::RobotDescription& r) {
    ForEachJoint(r, [](core::JointDescription& joint) { joint.velocity_radps = 1.5; });
  });
  const WalkFinding finding = Find(robot, WalkTopic::kSpeed);
  EXPECT_EQ(finding.grade, WalkGrade::kNotMet);
  EXPECT_TRUE(finding.text.starts_with("to swing a leg at 0.5 m/s, ")) << finding.text;
  EXPECT_NE(finding.text.find(" of 1.5 rad/s; it is too slow: walk at "), std::string::npos)
      << finding.text;
  EXPECT_TRUE(
      finding.text.ends_with(" m/s at most, or set the drive's own limits.kfe.velocity_radps"))
      << finding.text;
  const core::RobotDescription unlimited = Changed([](core::RobotDescription& r) {
    ForEachJoint(r, [](core::JointDescription& joint) { joint.velocity_radps = 0.0; });
  });
  EXPECT_EQ(Find(unlimited, WalkTopic::kSpeed).grade, WalkGrade::kMet) << "0 is unlimited";
}

// The same robot in another size, with joints that are slower by the square root of the length,
// has the same to spare at the speed of the same Froude number.
TEST(Verdict, SwingGoesWithTheSizeOfTheRobot) {
  const auto needed = [](const core::RobotDescription& robot, double speed_mps) {
    WalkConditions conditions = Conditions();
    conditions.speed_mps = speed_mps;
    const std::string text = Find(robot, WalkTopic::kSpeed, conditions).text;
    return std::stod(text.substr(text.find("turns at ") + 9));
  };
  constexpr double kLength = 1.96;
  const core::RobotDescription large = Changed([kLength](core::RobotDescription& r) {
    r.similarity.length = kLength;
    r.config.nominal_height_m *= kLength;
    r.config.stance_front_m *= kLength;
    r.config.stance_hind_m *= kLength;
    for (core::LegDescription& leg : r.legs) {
      for (core::JointDescription& joint : leg.joints) joint.p_PJ *= kLength;
      leg.p_LF *= kLength;
    }
  });
  EXPECT_NEAR(needed(large, 0.7) * 1.4, needed(test::Go2(), 0.5), 0.05);
}

TEST(Verdict, FeetThatCannotReachTheirPlacesAreNamed) {
  const core::RobotDescription high =
      Changed([](core::RobotDescription& r) { r.config.nominal_height_m = 0.5; });
  const WalkFinding finding = Find(high, WalkTopic::kReach);
  EXPECT_EQ(finding.grade, WalkGrade::kNotMet);
  EXPECT_TRUE(finding.text.starts_with("standing, FL misses its place by 0.11")) << finding.text;
  EXPECT_TRUE(finding.text.ends_with(
      " m: joint limits or legs do not reach; set nominal_height_m, stance_front_m, stance_hind_m, "
      "knees or limits"))
      << finding.text;
  const core::RobotDescription stiff = Changed([](core::RobotDescription& r) {
    for (core::LegDescription& leg : r.legs) leg.joints[2].lower_rad = -1.7;
  });
  EXPECT_TRUE(Find(stiff, WalkTopic::kReach).text.starts_with("lifted for a swing, FL misses"))
      << Find(stiff, WalkTopic::kReach).text;
  const core::RobotDescription tight =
      Changed([](core::RobotDescription& r) { r.config.max_leg_length_m = 0.305; });
  EXPECT_EQ(Find(tight, WalkTopic::kReach).grade, WalkGrade::kScarce);
  EXPECT_EQ(Find(tight, WalkTopic::kReach).text,
            "at 0.5 m/s a leg is up to 0.309 of 0.305 m long; strides will be shortened: a lower "
            "nominal_height_m");
}

TEST(Verdict, ForceBoundOfTwoFeet) {
  WalkConditions conditions = Conditions();
  conditions.f_max_N = 70.0;
  const WalkFinding finding = Find(test::Go2(), WalkTopic::kForce, conditions);
  EXPECT_EQ(finding.grade, WalkGrade::kNotMet);
  EXPECT_EQ(finding.text,
            "15.0 kg are 74 N per foot on two feet, more than controller.mpc.f_max_N 70; raise it");
}

TEST(Verdict, SensingAgainstTheWeightOfAFoot) {
  const core::RobotDescription light = Changed([](core::RobotDescription& r) {
    r.trunk.mass_kg = 1.0;
    for (core::LegDescription& leg : r.legs) {
      for (core::Body& link : leg.links) link.mass_kg = 0.1;
    }
  });
  const WalkFinding feet = Find(light, WalkTopic::kSensing);
  EXPECT_EQ(feet.grade, WalkGrade::kScarce);
  EXPECT_EQ(feet.text,
            "foot sensors count a foot as loaded from 13.5 N on, a standing foot bears 5.4 N: "
            "contact will be missed; set sensors.foot_force.gain_per_N and dead_band_N, or "
            "has_foot_sensors: false");
  WalkConditions bare = Conditions();
  bare.foot_threshold_N.reset();
  const WalkFinding torques = Find(light, WalkTopic::kSensing, bare);
  EXPECT_EQ(torques.grade, WalkGrade::kScarce);
  EXPECT_TRUE(
      torques.text.ends_with(" N, a standing foot bears 5.4 N: contact and mass will be wrong; set "
                             "sensors.torque.offset_Nm and noise_Nm to the drives' own"))
      << torques.text;
  EXPECT_EQ(Verdict({feet}), "may walk, with little to spare: sensing");
  bare.torque_error_Nm.reset();
  EXPECT_EQ(Find(light, WalkTopic::kSensing, bare).grade, WalkGrade::kMet);
}

}  // namespace
}  // namespace scoria::app
