// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/velocity_smoother.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

constexpr double kTick_s = 0.002, kPeriod_s = 0.5;

Vec3 TrueVelocity(double time_s) {
  const double turns = time_s / kPeriod_s;
  return {0.3 + 0.05 * std::sin(2.0 * std::numbers::pi * turns), 0.02, 0.0};
}

Vec3 TrueAcceleration(double time_s) {
  const double w_radps = 2.0 * std::numbers::pi / kPeriod_s;
  return {0.05 * w_radps * std::cos(w_radps * time_s), 0.0, 0.0};
}

/// A trot: diagonal feet in turn, half a period each, with the noise of encoders.
std::vector<VelocityClue> Trot(double duration_s) {
  constexpr double kNoise_mps = 0.01;
  core::Rng rng(7, 0, core::Stream::kEncoder);
  std::vector<VelocityClue> clues;
  for (int k = 0; k < std::lround(duration_s / kTick_s); ++k) {
    VelocityClue& clue = clues.emplace_back();
    clue.time_s = k * kTick_s;
    clue.a_WS = TrueAcceleration(clue.time_s);
    const bool first = std::fmod(clue.time_s, kPeriod_s) < 0.5 * kPeriod_s;
    for (const Leg leg : kLegs) {
      const bool is_first = leg == Leg::kFL || leg == Leg::kHR;
      if (is_first != first) continue;
      clue.v_WS[leg] = TrueVelocity(clue.time_s) +
                       kNoise_mps * Vec3(rng.NextNormal(), rng.NextNormal(), rng.NextNormal());
    }
  }
  return clues;
}

Vec3 WorstError(const std::vector<VelocityClue>& clues, const std::vector<Vec3>& v_WS) {
  Vec3 worst = Vec3::Zero();
  for (std::size_t k = 0; k < clues.size(); ++k)
    worst = worst.cwiseMax((v_WS[k] - TrueVelocity(clues[k].time_s)).cwiseAbs());
  return worst;
}

TEST(VelocitySmoother, IsTrueWhereFeetHold) {
  const std::vector<VelocityClue> clues = Trot(4.0);
  EXPECT_LT(WorstError(clues, SmoothVelocity(clues)).maxCoeff(), 0.005);
}

TEST(VelocitySmoother, FeetThatSlipForAThirdOfAStanceLoseTheirWeight) {
  std::vector<VelocityClue> clues = Trot(4.0);
  constexpr double kSlip_mps = 0.3;
  double mean_error = 0.0;
  for (VelocityClue& clue : clues) {
    const bool slips = std::fmod(clue.time_s, 0.5 * kPeriod_s) < kPeriod_s / 6.0;
    for (const Leg leg : kLegs) {
      if (slips && clue.v_WS[leg]) clue.v_WS[leg]->x() += kSlip_mps;
    }
    mean_error += (slips ? kSlip_mps : 0.0) / static_cast<double>(clues.size());
  }
  EXPECT_NEAR(mean_error, 0.1, 0.01) << "of the mean of the feet";
  EXPECT_LT(WorstError(clues, SmoothVelocity(clues)).maxCoeff(), 0.03);
}

TEST(VelocitySmoother, BiasOfTheAccelerometerIsFound) {
  std::vector<VelocityClue> clues = Trot(4.0);
  for (VelocityClue& clue : clues) *clue.a_WS += Vec3(0.2, -0.1, 0.15);
  EXPECT_LT(WorstError(clues, SmoothVelocity(clues)).maxCoeff(), 0.01);
}

TEST(VelocitySmoother, FlightIsTheAccelerometers) {
  std::vector<VelocityClue> clues = Trot(4.0);
  const auto in_flight = [](double time_s) { return time_s > 2.1 && time_s < 2.4; };
  for (VelocityClue& clue : clues) {
    if (in_flight(clue.time_s)) clue.v_WS = {};
  }
  EXPECT_LT(WorstError(clues, SmoothVelocity(clues)).maxCoeff(), 0.01);
  for (VelocityClue& clue : clues) clue.a_WS.reset();
  const std::vector<Vec3> v_WS = SmoothVelocity(clues);
  for (std::size_t k = 0; k < clues.size(); ++k) {
    const double bound = in_flight(clues[k].time_s) ? 0.1 : 0.04;
    EXPECT_LT((v_WS[k] - TrueVelocity(clues[k].time_s)).norm(), bound) << clues[k].time_s;
  }
}

TEST(VelocitySmoother, BlocksGiveWhatTheWholeGivesOnceAndInOrder) {
  const std::vector<VelocityClue> clues = Trot(60.0);
  const std::vector<Vec3> whole = SmoothVelocity(clues);
  VelocitySmoother smoother;
  std::vector<Vec3> given;
  const auto take = [&] {
    for (const Vec3& v_WS : smoother.Take()) given.push_back(v_WS);
  };
  for (const VelocityClue& clue : clues) {
    smoother.Add(clue);
    take();
  }
  EXPECT_GT(given.size(), clues.size() / 3);
  smoother.Finish();
  take();
  ASSERT_EQ(given.size(), whole.size());
  for (std::size_t k = 0; k < given.size(); ++k)
    EXPECT_LT((given[k] - whole[k]).norm(), 0.002) << k;
  smoother.Add(clues.front());
  smoother.Finish();
  EXPECT_EQ(smoother.Take().size(), 1U) << "another stretch, of one clue";
}

}  // namespace
}  // namespace scoria::analysis
