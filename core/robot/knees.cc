// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/knees.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace scoria::core {
namespace {

constexpr double kBent_rad = 0.5;  // a knee that can bend so far stands on a bent leg

bool Allows(const LegDescription& leg, double way) {
  const JointDescription& knee = leg.joints[2];
  return way < 0.0 ? knee.lower_rad < -kBent_rad : knee.upper_rad > kBent_rad;
}

/// The way of a knee that the URDF's zero shows bent.
std::optional<double> WayAtZero(const LegDescription& leg) {
  constexpr double kClear_rad = 0.1;  // a foot beside the shank's axis alone bends less
  const JointDescription& knee = leg.joints[2];
  const double angle_rad =
      std::remainder(-knee.urdf_sign * knee.urdf_zero_rad, 2.0 * EIGEN_PI);  // at the URDF's zero
  if (std::abs(angle_rad) < kClear_rad) return std::nullopt;
  return std::copysign(1.0, angle_rad);
}

/// Whether what is +a on one shank is -a on the other, beyond what rounding explains.
bool AreOpposite(double a, double b, double floor) {
  constexpr double kAlike = 0.25;
  return a * b < 0.0 && std::min(std::abs(a), std::abs(b)) > floor &&
         std::abs(a + b) < kAlike * (std::abs(a) + std::abs(b));
}

/// Shanks that are images of each other in the plane between front and hind legs.
bool AreMirrored(const LegDescription& front, const LegDescription& hind) {
  constexpr double kShare = 0.01;
  const Body &f = front.links[2], &h = hind.links[2];
  return AreOpposite(f.p_OC.x(), h.p_OC.x(), kShare * front.p_LF.norm()) ||
         AreOpposite(f.I_C(0, 2), h.I_C(0, 2), kShare * f.I_C.trace());
}

/// By the YAML or the leg's own limits; `otherwise` where both leave it open.
double FindWay(const LegDescription& leg, KneeBend bend, double otherwise) {
  if (bend != KneeBend::kAuto) return bend == KneeBend::kForward ? 1.0 : -1.0;
  if (BendsEitherWay(leg)) return otherwise;
  return Allows(leg, -1.0) ? -1.0 : 1.0;
}

/// What tells of a free knee: of a left leg its zero, then what its neighbour in front does; of a
/// right leg what the left one does.
double FindFreeWay(const RobotDescription& robot, Leg which) {
  const LegDescription &fl = robot.legs[Leg::kFL], &hl = robot.legs[Leg::kHL];
  switch (which) {
    case Leg::kFL:
      return WayAtZero(fl).value_or(-1.0);
    case Leg::kHL:
      return WayAtZero(hl).value_or(AreMirrored(fl, hl) ? -fl.knee_way : fl.knee_way);
    case Leg::kFR:
      return fl.knee_way;
    case Leg::kHR:
      break;
  }
  return hl.knee_way;
}

/// Puts given limits over a joint's; a mirrored joint turns the other way.
void Override(const JointLimitParams& given, bool mirrored, JointDescription& joint) {
  const auto negated = [](const std::optional<double>& v) {
    return v ? std::optional(-*v) : std::nullopt;
  };
  joint.lower_rad =
      (mirrored ? negated(given.upper_rad) : given.lower_rad).value_or(joint.lower_rad);
  joint.upper_rad =
      (mirrored ? negated(given.lower_rad) : given.upper_rad).value_or(joint.upper_rad);
  joint.effort_Nm = given.effort_Nm.value_or(joint.effort_Nm);
  joint.velocity_radps = given.velocity_radps.value_or(joint.velocity_radps);
}

std::string OverrideLimits(const LegLimitParams& limits, Leg which, bool knees_mirrored,
                           LegDescription& leg) {
  Override(limits.haa, !IsLeft(which), leg.joints[0]);
  Override(limits.hfe, knees_mirrored, leg.joints[1]);
  Override(limits.kfe, knees_mirrored, leg.joints[2]);
  for (const JointDescription& joint : leg.joints) {
    if (joint.lower_rad < joint.upper_rad) continue;
    return fmt::format("limits: {} would have [{:.3f}, {:.3f}] rad", joint.name, joint.lower_rad,
                       joint.upper_rad);
  }
  return "";
}

std::string Forbidden(const LegDescription& leg, Leg which) {
  const JointDescription& knee = leg.joints[2];
  return fmt::format(
      "knees.{}: {} is beyond the limits [{:.3f}, {:.3f}] rad of {}; they leave {} less than "
      "{} rad that way",
      IsFront(which) ? "front" : "hind", leg.knee_way < 0.0 ? "back" : "forward", knee.lower_rad,
      knee.upper_rad, knee.name, LegName(which), kBent_rad);
}

}  // namespace

bool BendsEitherWay(const LegDescription& leg) { return Allows(leg, -1.0) && Allows(leg, 1.0); }

std::string SettleKneesAndLimits(RobotDescription& robot) {
  const RobotConfig& config = robot.config;
  for (const Leg which : kLegs) {
    LegDescription& leg = robot.legs[which];
    const KneeBend bend = IsFront(which) ? config.knees.front : config.knees.hind;
    std::string problem;
    if (IsFront(which)) problem = OverrideLimits(config.limits, which, false, leg);
    leg.knee_way = FindWay(leg, bend, FindFreeWay(robot, which));
    if (!IsFront(which)) {
      const bool is_mirrored = leg.knee_way != robot.legs[Leg::kFL].knee_way;
      problem = OverrideLimits(config.limits, which, is_mirrored, leg);
    }
    if (!problem.empty()) return problem;
    if (bend != KneeBend::kAuto && !Allows(leg, leg.knee_way)) return Forbidden(leg, which);
  }
  return "";
}

}  // namespace scoria::core
