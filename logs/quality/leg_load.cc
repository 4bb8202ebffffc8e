// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/leg_load.h"

#include <cmath>

#include <Eigen/LU>

namespace scoria::logs {

std::optional<Vec3> CalcFootForce(const core::LegKinematics& leg, const Vec3& tau,
                                  double leg_length_m) {
  const double scale = leg_length_m * leg_length_m * leg_length_m / 8.0;
  if (std::abs(leg.J.determinant()) < kLeastDeterminant * scale) return std::nullopt;
  return Vec3(-leg.J.transpose().inverse() * tau);
}

double LegLength(const core::LegDescription& leg) noexcept {
  return leg.joints[2].p_PJ.norm() + leg.p_LF.norm();
}

std::optional<Vec3> CalcForceOfFeet(const core::RobotDescription& robot, const Tick& tick) {
  if (!tick.q || !tick.tau) return std::nullopt;
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) {
    const core::LegDescription& description = robot.legs[leg];
    const auto force = CalcFootForce(core::CalcLegKinematics(description, (*tick.q)[leg]),
                                     (*tick.tau)[leg], LegLength(description));
    if (!force) return std::nullopt;
    sum += *force;
  }
  return sum;
}

}  // namespace scoria::logs
