// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/description.h"

namespace scoria::core {

void MergeInertia(Body& body, const SpatialInertia& link) {
  if (link.mass_kg <= 0.0) return;
  const double total = body.mass_kg + link.mass_kg;
  const Vec3 c = (body.mass_kg * body.p_OC + link.mass_kg * link.p_OC) / total;
  body.I_C += PointInertia(body.mass_kg, body.p_OC - c) + link.I_C +
              PointInertia(link.mass_kg, link.p_OC - c);
  body.mass_kg = total;
  body.p_OC = c;
}

double RobotDescription::total_mass_kg() const {
  double mass = 0.0;
  for (int i = 0; i < kNumBodies; ++i) mass += body(i).mass_kg;
  return mass;
}

Vec3 RobotDescription::NeutralFoothold(Leg leg) const {
  Vec3 p = IsFront(leg) ? config.stance_front_m : config.stance_hind_m;
  if (!IsLeft(leg)) p.y() = -p.y();
  return p;
}

LegArray<Vec3> RobotDescription::EffortLimits() const {
  LegArray<Vec3> limits = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      limits[leg][j] = legs[leg].joints[static_cast<std::size_t>(j)].effort_Nm;
    }
  }
  return limits;
}

const Body& RobotDescription::body(int index) const {
  if (index == 0) return trunk;
  return legs[LegOf(index)].links[static_cast<std::size_t>(JointOf(index))];
}

}  // namespace scoria::core
