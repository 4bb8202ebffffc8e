// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "controller/stand_up.h"
#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"

namespace scoria::app {
namespace {

constexpr std::array<const char*, 3> kLimitKeys = {"haa", "hfe", "kfe"};

/// A trot as the Go2 has it, its times and lengths scaled to the robot's legs.
struct Trot {
  double stance_s, swing_s, travel_m, lift_m;
};
Trot TrotOf(const core::RobotDescription& robot, double speed_mps) {
  constexpr double kPeriod_s = 0.5, kDuty = 0.6, kLift_m = 0.08;
  const double period_s = kPeriod_s * robot.similarity.Factor(core::dimension::kTime);
  return {kDuty * period_s, (1.0 - kDuty) * period_s, kDuty * period_s * speed_mps,
          kLift_m * robot.similarity.Factor(core::dimension::kLength)};
}

/// What a joint needs against what it has.
struct Need {
  std::string joint;
  std::size_t kind = 0;  // HAA, HFE, KFE
  double needed = 0.0, limit = 1.0;
  [[nodiscard]] double share() const { return needed / std::max(limit, 1e-9); }
};

/// The joint with the least to spare.
void KeepTighter(const core::JointDescription& joint, std::size_t kind, double needed, double limit,
                 Need& worst) {
  const Need need{joint.name, kind, needed, limit};
  if (worst.joint.empty() || need.share() > worst.share()) worst = need;
}

WalkFinding JudgeTorque(const core::RobotDescription& robot, const WalkConditions& conditions) {
  constexpr double kSpare = 0.7;
  RobotState standing;
  standing.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  core::WholeBody wb;
  core::WholeBodyModel(robot, conditions.gravity_mps2).Calc(standing, wb);
  const Vec3 half_weight_N(0.0, 0.0, 0.5 * wb.mass_kg * conditions.gravity_mps2);
  Need worst;
  for (const Leg leg : kLegs) {
    const Vec3 torque_Nm = wb.h_l[leg] - wb.J_ll[leg].transpose() * half_weight_N;
    for (std::size_t j = 0; j < 3; ++j) {
      const core::JointDescription& joint = robot.legs[leg].joints[j];
      KeepTighter(joint, j, std::abs(torque_Nm[static_cast<Eigen::Index>(j)]), joint.effort_Nm,
                  worst);
    }
  }
  const WalkGrade grade = worst.share() > 1.0      ? WalkGrade::kNotMet
                          : worst.share() > kSpare ? WalkGrade::kScarce
                                                   : WalkGrade::kMet;
  std::string text = fmt::format("standing on two legs, {} needs {:.3g} of {:.3g} Nm", worst.joint,
                                 worst.needed, worst.limit);
  if (grade != WalkGrade::kMet) {
    text += fmt::format(
        "; {}: less mass, a nominal_height_m nearer to straight legs, or the "
        "drive's own limits.{}.effort_Nm",
        grade == WalkGrade::kNotMet ? "it cannot carry itself" : "little is left for walking",
        kLimitKeys[worst.kind]);
  }
  return {WalkTopic::kTorque, grade, text};
}

/// How far a foot stays from its place, m.
double MissOf(const core::RobotDescription& robot, Leg leg, const Vec3& offset) {
  const core::LegDescription& l = robot.legs[leg];
  const Vec3 p_BF =
      robot.NeutralFoothold(leg) - robot.config.nominal_height_m * Vec3::UnitZ() + offset;
  const double way = -core::KneeWay(l);
  const Vec3 q = core::SolveLegIk(l, p_BF, Vec3(0.0, 0.8 * way, -1.6 * way));
  return (core::CalcLegKinematics(l, q).p_BF - p_BF).norm();
}

WalkFinding JudgeReach(const core::RobotDescription& robot, const WalkConditions& conditions) {
  constexpr double kNear = 0.01;  // of the leg length
  const Trot trot = TrotOf(robot, conditions.speed_mps);
  const Vec3 along(0.5 * trot.travel_m, 0.0, 0.0), up(0.0, 0.0, trot.lift_m);
  struct Place {
    const char* name;
    Vec3 offset;
  };
  const std::array<Place, 4> places = {{{"standing", Vec3::Zero()},
                                        {"at the front end of the stance", along},
                                        {"at the hind end of the stance", -along},
                                        {"lifted for a swing", up}}};
  for (const Place& place : places) {
    for (const Leg leg : kLegs) {
      const double miss_m = MissOf(robot, leg, place.offset);
      if (miss_m <= kNear * core::LegLength(robot.legs[leg])) continue;
      return {WalkTopic::kReach, WalkGrade::kNotMet,
              fmt::format("{}, {} misses its place by {:.3g} m: joint limits or legs do not reach; "
                          "set nominal_height_m, stance_front_m, stance_hind_m, knees or limits",
                          place.name, LegName(leg), miss_m)};
    }
  }
  const core::LegDescription& leg = robot.legs[Leg::kFL];
  const Vec3 hip = leg.joints[0].p_PJ + leg.joints[1].p_PJ;
  const double down_m = robot.config.nominal_height_m + hip.z();
  const double length_m = std::hypot(down_m, along.x()), most_m = robot.config.max_leg_length_m;
  const bool is_scarce = length_m > most_m;
  return {WalkTopic::kReach, is_scarce ? WalkGrade::kScarce : WalkGrade::kMet,
          fmt::format("at {:g} m/s a leg is up to {:.3f} of {:.3f} m long{}", conditions.speed_mps,
                      length_m, most_m,
                      is_scarce ? "; strides will be shortened: a lower nominal_height_m" : "")};
}

/// The fastest that each joint of a leg turns while its foot swings.
Vec3 SwingRates(const core::RobotDescription& robot, Leg leg, const Trot& trot) {
  const core::LegDescription& l = robot.legs[leg];
  const Vec3 middle = robot.NeutralFoothold(leg) - robot.config.nominal_height_m * Vec3::UnitZ();
  const double way = -core::KneeWay(l);
  Vec3 q(0.0, 0.8 * way, -1.6 * way), most = Vec3::Zero();
  constexpr int kSamples = 40;
  for (int i = 0; i <= kSamples; ++i) {
    // Forwards by the quintic that starts and ends at rest, up and down by a quartic.
    const double s = static_cast<double>(i) / kSamples, r = s * (1.0 - s);
    const double x = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s) - 0.5, z = 16.0 * r * r;
    const Vec3 p_BF = middle + Vec3(trot.travel_m * x, 0.0, trot.lift_m * z);
    const Vec3 v_BF =
        Vec3(30.0 * trot.travel_m * r * r, 0.0, 32.0 * trot.lift_m * r * (1.0 - 2.0 * s)) /
        trot.swing_s;
    q = core::SolveLegIk(l, p_BF, q);
    const Vec3 qd = core::CalcLegKinematics(l, q).J.colPivHouseholderQr().solve(v_BF);
    most = most.cwiseMax(qd.cwiseAbs());
  }
  return most;
}

WalkFinding JudgeSpeed(const core::RobotDescription& robot, const WalkConditions& conditions) {
  constexpr double kUnlimited_radps = 1e9, kSpare = 0.8;
  const Trot trot = TrotOf(robot, conditions.speed_mps);
  Need worst;
  for (const Leg leg : kLegs) {
    const Vec3 rates = SwingRates(robot, leg, trot);
    for (std::size_t j = 0; j < 3; ++j) {
      const core::JointDescription& joint = robot.legs[leg].joints[j];
      KeepTighter(joint, j, rates[static_cast<Eigen::Index>(j)],
                  joint.velocity_radps > 0.0 ? joint.velocity_radps : kUnlimited_radps, worst);
    }
  }
  const WalkGrade grade = worst.share() > 1.0      ? WalkGrade::kNotMet
                          : worst.share() > kSpare ? WalkGrade::kScarce
                                                   : WalkGrade::kMet;
  std::string text = fmt::format(
      "to swing a leg at {:g} m/s, {} turns at {:.3g} of {} rad/s", conditions.speed_mps,
      worst.joint, worst.needed,
      worst.limit < kUnlimited_radps ? fmt::format("{:.3g}", worst.limit) : "unlimited");
  if (grade != WalkGrade::kMet) {
    text += fmt::format(
        "; {}: walk at {:.2g} m/s at most, or set the drive's own limits.{}.velocity_radps",
        grade == WalkGrade::kNotMet ? "it is too slow" : "little is left",
        conditions.speed_mps * kSpare / worst.share(), kLimitKeys[worst.kind]);
  }
  return {WalkTopic::kSpeed, grade, text};
}

WalkFinding JudgeForce(const core::RobotDescription& robot, const WalkConditions& conditions) {
  const double mass_kg = robot.total_mass_kg(), load_N = 0.5 * mass_kg * conditions.gravity_mps2;
  if (load_N > conditions.f_max_N) {
    return {WalkTopic::kForce, WalkGrade::kNotMet,
            fmt::format("{:.1f} kg are {:.0f} N per foot on two feet, more than "
                        "controller.mpc.f_max_N {:g}; raise it",
                        mass_kg, load_N, conditions.f_max_N)};
  }
  return {WalkTopic::kForce, WalkGrade::kMet,
          fmt::format("{:.1f} kg are {:.0f} N per foot on two feet, of at most {:g} N", mass_kg,
                      load_N, conditions.f_max_N)};
}

/// Standard deviation of a foot's vertical force by torques with an error of 1 Nm each, 1/m.
double ForceErrorPerTorque(const core::RobotDescription& robot) {
  const auto pose = controller::StandingPose(robot, robot.config.nominal_height_m);
  const Mat3 J = core::CalcLegKinematics(robot.legs[Leg::kFL], pose[Leg::kFL]).J;
  return J.transpose().inverse().row(2).norm();
}

WalkFinding JudgeSensing(const core::RobotDescription& robot, const WalkConditions& conditions) {
  constexpr double kLargestError = 0.1, kLargestThreshold = 1.0;  // of a standing foot's load
  const double load_N = 0.25 * robot.total_mass_kg() * conditions.gravity_mps2;
  if (conditions.foot_threshold_N.value_or(0.0) > kLargestThreshold * load_N) {
    return {WalkTopic::kSensing, WalkGrade::kScarce,
            fmt::format("foot sensors count a foot as loaded from {:.3g} N on, a standing foot "
                        "bears {:.3g} N: contact will be missed; set "
                        "sensors.foot_force.gain_per_N and dead_band_N, or has_foot_sensors: false",
                        *conditions.foot_threshold_N, load_N)};
  }
  const double error_N = conditions.torque_error_Nm.value_or(0.0) * ForceErrorPerTorque(robot);
  if (error_N > kLargestError * load_N) {
    return {WalkTopic::kSensing, WalkGrade::kScarce,
            fmt::format("by its joint torques a foot's force is known to {:.2g} N, a standing foot "
                        "bears {:.3g} N: contact and mass will be wrong; set sensors.torque."
                        "offset_Nm and noise_Nm to the drives' own",
                        error_N, load_N)};
  }
  return {WalkTopic::kSensing, WalkGrade::kMet,
          fmt::format("by its joint torques a foot's force is known to {:.2g} N, a standing foot "
                      "bears {:.3g} N",
                      error_N, load_N)};
}

std::string Topics(const std::vector<WalkFinding>& findings, WalkGrade grade) {
  std::vector<std::string_view> names;
  for (const WalkFinding& finding : findings) {
    if (finding.grade == grade) names.push_back(core::EnumName(finding.topic));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<WalkFinding> JudgeRobot(const core::RobotDescription& robot,
                                    const WalkConditions& conditions) {
  return {JudgeTorque(robot, conditions), JudgeReach(robot, conditions),
          JudgeSpeed(robot, conditions), JudgeForce(robot, conditions),
          JudgeSensing(robot, conditions)};
}

std::string Verdict(const std::vector<WalkFinding>& findings) {
  const std::string missing = Topics(findings, WalkGrade::kNotMet),
                    scarce = Topics(findings, WalkGrade::kScarce);
  if (!missing.empty()) return fmt::format("cannot walk as it is: {}", missing);
  if (!scarce.empty()) return fmt::format("may walk, with little to spare: {}", scarce);
  return "nothing in these files keeps it from walking";
}

}  // namespace scoria::app
