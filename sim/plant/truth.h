// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/spatial_inertia.h"
#include "core/robot/state.h"

namespace scoria::sim {

/// Work done on the robot, J: impulse times the mean of the velocities before and after.
struct Work {
  double motor_J = 0.0, joint_J = 0.0, contact_J = 0.0, external_J = 0.0;
  Work& operator+=(const Work& w) noexcept {
    motor_J += w.motor_J;
    joint_J += w.joint_J;
    contact_J += w.contact_J;
    external_J += w.external_J;
    return *this;
  }
  bool operator==(const Work&) const = default;
};

/// Where the robot's mechanical energy came from and went, J since Reset. Whatever the sum of works
/// does not explain of the change of energy is the integrator's error. What payloads bring and take
/// is external work; the damper of a sliding one is a joint.
struct EnergyLedger {
  Work work;
  double kinetic_J = 0.0, potential_J = 0.0;  // now; rotors included, potential from z = 0
  double initial_J = 0.0;                     // kinetic and potential at Reset
  [[nodiscard]] double Error_J() const noexcept {
    return kinetic_J + potential_J - initial_J -
           (work.motor_J + work.joint_J + work.contact_J + work.external_J);
  }
  bool operator==(const EnergyLedger&) const = default;
};

/// The true state of the robot and of its contacts after a step. Forces act on the robot.
struct Truth {
  RobotState state;
  Vec3 a_WB = Vec3::Zero();               // m/s^2, mean over the last step
  Vec3 p_WC = Vec3::Zero();               // centre of mass, payloads included
  double mass_kg = 0.0;                   // likewise
  core::SpatialInertia trunk;             // with all that is fixed to it
  double slide_m = 0.0, slide_mps = 0.0;  // of a sliding payload
  LegArray<Vec3> p_WF = ZeroPerLeg();     // foot sphere centres
  LegArray<Vec3> f_F_W = ZeroPerLeg();    // N, ground on foot
  LegArray<double> f_normal_N;            // its share along the ground's normal
  LegArray<bool> contact;                 // f_normal_N above 5 N on a Go2, as much on others
  LegArray<double> penetration_m;         // > 0 inside the ground
  double trunk_force_N = 0.0;             // magnitude of all ground force on the trunk
  EnergyLedger energy;
  bool operator==(const Truth&) const = default;
};

}  // namespace scoria::sim
