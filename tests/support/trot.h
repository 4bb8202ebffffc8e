// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/contact_estimator.h"
#include "core/rng.h"
#include "core/robot/description.h"
#include "tests/support/motion.h"
#include "tests/support/robots.h"

namespace scoria::test {

/// A Go2 that trots on the spot, and the contact estimator that senses it: torques and foot sensors
/// as the planned contacts ask for, trunk and joints at rest.
class Trot {
 public:
  static constexpr double kPeriod_s = 0.5, kDuty = 0.6, kLoad_N = 75.0, kRise_s = 0.005;
  static constexpr double kZero_counts = 12.0, kGain_counts_per_N = 0.5;
  /// What the front left sensor says instead of its counts, `since_s` after the fault began.
  using Fault = double (*)(double counts, double since_s);

  explicit Trot(const controller::ContactParams& params = {},
                const core::RobotDescription& robot = Go2());

  const ContactEstimate& Step();
  void Run(double seconds);
  /// Time until the front left sensor's health is `wanted`; no more than `limit_s`.
  double TimeUntilHealth(bool wanted, double limit_s);
  [[nodiscard]] const ContactEstimate& out() const { return out_; }

  controller::ContactEstimator estimator;
  LegArray<bool> contact;
  Fault fault = nullptr;
  bool standing = false, give_truth = false;
  double noise_counts = 0.8;

 private:
  void Load(double time_s);
  SensorFrame Measure();

  core::RobotDescription robot_;
  core::Rng rng_;
  Motion motion_;
  core::WholeBody wb_;
  ContactPlan plan_;
  ContactEstimate out_;
  int tick_ = 0, fault_tick_ = 0;
};

}  // namespace scoria::test
