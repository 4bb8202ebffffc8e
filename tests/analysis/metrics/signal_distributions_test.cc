// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/signal_distributions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/robots.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

/// A row of 100 Hz of a walk at 0.5 m/s, of 60 W, with strides of 0.8 s of which 0.5 s stand: a
/// foot slides 10 mm while it stands.
logs::Row RowAt(int k) {
  logs::Row row = test::WholeRow();
  row.time_s = 0.01 * k;
  row.episode->operating = true;
  row.command->v_x_mps = 0.5;
  row.truth->p_WB_m[0] = 0.5 * row.time_s;
  row.truth->rpy_rad = {0.03, 0.04, 0.0};
  row.true_mass->mass_kg = 15.0;
  row.true_mass->p_WC_z_m = 0.3;
  row.reference->p_WC_m[2] = 0.28;
  row.energy->mech_abs_J = 60.0 * row.time_s;
  row.measured->tau_Nm.emplace().fill(-2.0);
  row.measured->qd_radps.emplace().fill(3.0);
  row.estimate->innovation = logs::Innovation{4.5, 3};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double since_s = 0.01 * ((k + 20 * static_cast<int>(leg)) % 80);
    const bool down = since_s < 0.495;
    row.true_contacts->contact[leg] = row.contacts->contact[leg] = down;
    (*row.true_contacts->p_WF_m)[3 * leg] = down ? 0.01 * since_s / 0.49 : 0.0;
    (*row.contacts->f_F_W_N)[3 * leg + 2] = 60.0;
  }
  return row;
}

double Median(const SignalDistributions& of, Signal signal) { return of.at(signal).Quantile(0.5); }

TEST(SignalAccumulator, MeasuresEverySignalOfAWalk) {
  const core::RobotDescription& robot = test::Go2();
  SignalAccumulator signals(9.81, &robot);
  for (int k = 0; k < 2000; ++k) signals.AddRow(RowAt(k));
  const SignalDistributions& found = signals.Finish();
  ASSERT_EQ(found.size(), kNumSignals);
  constexpr double kBin = 0.02;  // its width
  const auto expect = [&](Signal signal, double value) {
    EXPECT_NEAR(Median(found, signal), value, kBin * value) << InfoOf(signal).title;
  };
  expect(Signal::kStride, 0.8);
  expect(Signal::kDuty, 0.5 / 0.8);
  expect(Signal::kFootForce, 60.0);
  expect(Signal::kTorqueUse, 2.0 / robot.legs[Leg::kFL].joints[0].effort_Nm);
  expect(Signal::kSpeedUse, 3.0 / robot.legs[Leg::kFL].joints[0].velocity_radps);
  expect(Signal::kSlip, 0.01);
  expect(Signal::kCost, 60.0 / (15.0 * 9.81 * 0.5));
  expect(Signal::kNis, 1.5);
  expect(Signal::kHeightError, 0.02);
  expect(Signal::kTiltError, 0.05);
}

TEST(SignalAccumulator, LeavesOutWhatIsNoWalking) {
  SignalAccumulator signals(9.81, nullptr);
  for (int k = 0; k < 200; ++k) {
    logs::Row row = RowAt(k);
    row.episode->operating = false;
    signals.AddRow(row);
  }
  EXPECT_TRUE(signals.Finish().empty());
}

TEST(SignalAccumulator, APlacementIsNoWayAndNoStride) {
  SignalAccumulator signals(9.81, nullptr);
  for (int k = 0; k < 100; ++k) {  // each second step of 0.3 s is moved by 10 m
    logs::Row row = RowAt(k);
    row.episode->segment = static_cast<std::uint32_t>(k / 30);
    row.truth->p_WB_m[0] += 10.0 * row.episode->segment;
    signals.AddRow(row);
  }
  EXPECT_FALSE(signals.Finish().contains(Signal::kCost)) << "no chord of half a second is whole";
  EXPECT_FALSE(signals.Finish().contains(Signal::kStride));
  EXPECT_FALSE(signals.Finish().contains(Signal::kTorqueUse)) << "a robot's limits are not known";
}

TEST(Signal, HasATitleAKeyAndADefinition) {
  for (const auto& [signal, name] : EnumNames(Signal{})) {
    const MetricInfo info = InfoOf(signal);
    EXPECT_EQ(info.key, name);
    EXPECT_FALSE(info.title.empty());
    EXPECT_TRUE(info.definition.ends_with('.'));
    EXPECT_TRUE(info.needs.any());
  }
}

}  // namespace
}  // namespace scoria::analysis
