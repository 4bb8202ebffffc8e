// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/trot.h"

#include <algorithm>
#include <cmath>

namespace scoria::test {

Trot::Trot(const controller::ContactParams& params, const core::RobotDescription& robot)
    : estimator(params, robot, kGravity_mps2, kStep_s),
      robot_(robot),
      rng_(3, 0, core::Stream::kSensor) {
  const core::WholeBodyModel model(robot_, kGravity_mps2);
  motion_.state = StandingState();
  model.Calc(motion_.state, wb_);
  plan_.duty = LegArray<double>(kDuty);
  plan_.period_s = kPeriod_s;
  plan_.standing = false;
}

const ContactEstimate& Trot::Step() {
  Load(tick_ * kStep_s);
  const SensorFrame z = Measure();
  ++tick_;
  out_ = estimator.Update({z, wb_, plan_, 0.0, {}, robot_.legs[Leg::kFL].foot_radius_m});
  return out_;
}

/// Plan, contacts and forces at that time.
void Trot::Load(double time_s) {
  for (const Leg leg : kLegs) {
    const bool diagonal = leg == Leg::kFL || leg == Leg::kHR;
    const double turns = time_s / kPeriod_s + (diagonal ? 0.0 : 0.5);
    plan_.phase[leg] = standing ? 0.3 : turns - std::floor(turns);
    contact[leg] = plan_.phase[leg] < kDuty;
    const double stance_s = plan_.phase[leg] * kPeriod_s;
    motion_.f_F_W[leg].z() = contact[leg] ? kLoad_N * std::min(1.0, stance_s / kRise_s) : 0.0;
  }
  plan_.standing = standing;
}

SensorFrame Trot::Measure() {
  SensorFrame z = Sense(robot_, wb_, motion_);
  for (const Leg leg : kLegs) {
    const double load_N = motion_.f_F_W[leg].z();
    z.foot_force_raw[leg] =
        std::round(kZero_counts + kGain_counts_per_N * load_N + noise_counts * rng_.NextNormal());
  }
  if (fault != nullptr) {
    z.foot_force_raw[Leg::kFL] = fault(z.foot_force_raw[Leg::kFL], fault_tick_ * kStep_s);
    ++fault_tick_;
  } else {
    fault_tick_ = 0;
  }
  if (give_truth) z.truth = SensorFrame::Truth{motion_.state, contact};
  return z;
}

void Trot::Run(double seconds) {
  for (int i = 0; i < Ticks(seconds); ++i) (void)Step();
}

double Trot::TimeUntilHealth(bool wanted, double limit_s) {
  int ticks = 0;
  while (ticks < Ticks(limit_s) && Step().sensor_healthy[Leg::kFL] != wanted) ++ticks;
  return ticks * kStep_s;
}

}  // namespace scoria::test
