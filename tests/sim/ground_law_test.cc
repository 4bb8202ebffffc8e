// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ground_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sim/plant/plant.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

const Vec3 kGravity(0.0, 0.0, -9.81);
constexpr double kRadius_m = 0.022;

terrains::GroundSample Uniform(double stiffness_N_per_m3) {
  return {0.5, stiffness_N_per_m3, stiffness_N_per_m3, 0.0, 0.5};
}

LegArray<Vec3> Hold(const RobotState& s, const LegArray<Vec3>& q, double kp = 400.0,
                    double kd = 6.0) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (const Leg leg : kLegs) tau[leg] = kp * (q[leg] - s.q[leg]) - kd * s.qd[leg];
  return tau;
}

// Sinkage of a 22 mm sphere under a quarter, a half and the whole of a 15 kg robot; terrain
// reference, section 3. 3 % and 0.05 mm: the table is rounded.
TEST(GroundLaw, SinkageOfTheReferenceMaterials) {
  struct Case {
    double k_s, at_37N_mm, at_75N_mm, at_150N_mm;
  };
  for (const Case& c :
       {Case{4e5, 61, 123, 247}, Case{8.9e5, 27, 55, 111}, Case{1.5e6, 17, 33, 66},
        Case{3e6, 11, 17, 33}, Case{5e7, 2.4, 3.4, 4.9}, Case{1e9, 0.5, 0.7, 1.1}}) {
    for (const auto& [load_N, want_mm] :
         {std::pair{37.0, c.at_37N_mm}, {75.0, c.at_75N_mm}, {150.0, c.at_150N_mm}}) {
      double low = 0.0, high = 1.0;
      for (int i = 0; i < 60; ++i) {
        const double z = 0.5 * (low + high);
        (CalcSinkageForce(Uniform(c.k_s), kRadius_m, z) < load_N ? low : high) = z;
      }
      EXPECT_NEAR(1e3 * low, want_mm, 0.03 * want_mm + 0.05) << c.k_s << " at " << load_N << " N";
    }
  }
}

TEST(GroundLaw, SubstrateTakesOverBelowTheLayer) {
  const terrains::GroundSample layered{0.5, 1.5e6, 5e7, 0.02, 0.5};
  const auto force = [&](double z) { return CalcSinkageForce(layered, kRadius_m, z); };
  EXPECT_EQ(force(0.019), CalcSinkageForce(Uniform(1.5e6), kRadius_m, 0.019));
  EXPECT_NEAR(force(0.02 + 1e-9), force(0.02), 1e-4);  // no step
  EXPECT_GT(force(0.025) - force(0.02), 10.0 * (force(0.02) - force(0.015)));
}

TEST(GroundLaw, StandingFeetSinkAsTheLawSays) {
  for (const double k_s : {1.5e6, 3e6, 5e7, 1e9}) {
    terrains::Heightfield flat = test::FlatGround();
    const terrains::Heightfield ground(flat.nodes(), flat.resolution_m(), flat.heights_m(),
                                       {.stiffness_N_per_m3 = k_s});
    Plant plant(test::Go2(), ground, {}, kGravity);
    const RobotState start = test::StandingState();
    plant.Reset(start);
    for (int i = 0; i < 4000; ++i) plant.Step(Hold(plant.truth().state, start.q));
    for (const Leg leg : kLegs) {
      const double want_N =
          CalcSinkageForce(Uniform(k_s), kRadius_m, plant.truth().penetration_m[leg]);
      EXPECT_NEAR(plant.truth().f_normal_N[leg], want_N, 0.01 * want_N) << k_s;
    }
  }
}

// Stiffness under a standing foot from 2e3 to 2e5 N/m, at 1 kHz: dropped from 5 cm, the robot comes
// to rest on any of them, elastic or plastic.
TEST(GroundLaw, EveryStiffnessIsStableAtOneKilohertz) {
  for (const GroundParams& kind : {GroundParams(ElasticGround{}), GroundParams(PlasticGround{})}) {
    for (const double k_N_per_m : {2e3, 5e3, 2e4, 5e4, 2e5}) {
      const double z = 37.0 / k_N_per_m;
      const double area = CalcSinkageForce(Uniform(1.0), kRadius_m, z) / z;
      terrains::Heightfield flat = test::FlatGround();
      const terrains::Heightfield ground(flat.nodes(), flat.resolution_m(), flat.heights_m(),
                                         {.stiffness_N_per_m3 = k_N_per_m / area});
      PhysicsParams params;
      params.ground = kind;
      Plant plant(test::Go2(), ground, params, kGravity);
      RobotState start = test::StandingState();
      const LegArray<Vec3> q = start.q;
      start.p_WB.z() += 0.05;
      plant.Reset(start);
      double most_J = 0.0;
      for (int i = 0; i < 6000; ++i) {
        plant.Step(Hold(plant.truth().state, q));
        const EnergyLedger& e = plant.truth().energy;
        most_J = std::max(most_J, e.kinetic_J + e.potential_J - e.initial_J - e.work.motor_J);
      }
      EXPECT_LT(plant.truth().energy.kinetic_J, 1e-5) << k_N_per_m;
      EXPECT_LT(most_J, 0.05) << k_N_per_m;
      EXPECT_GT(plant.truth().state.p_WB.z(), 0.2) << k_N_per_m;
    }
  }
}

ContactPoint Pressed(double sinkage_m, double normal_N = 0.0) {
  ContactPoint c;
  c.gap_m = -sinkage_m;
  c.impulse_W = {0.0, 0.0, 0.001 * normal_N};
  return c;
}

double SpringForce(const ContactPoint& c) { return c.stiffness_N_per_m * (-c.gap_m - c.rest_m); }

TEST(GroundLaw, PlasticGroundUnloadsStifferAndKeepsTheImprint) {
  FootGround foot(PlasticGround{}, kRadius_m, 4.0);
  const terrains::GroundSample ground = Uniform(3e6);
  const double deep_m = 0.010, deep_N = CalcSinkageForce(ground, kRadius_m, deep_m);
  foot.Finish(Pressed(deep_m, deep_N), Vec3::Zero(), 0.001);

  ContactPoint again = Pressed(deep_m);
  foot.Prepare(ground, Vec3::Zero(), 0.0, 0.001, again);
  EXPECT_NEAR(SpringForce(again), deep_N, 1e-9);
  EXPECT_NEAR(again.stiffness_N_per_m, 7.0 * deep_N / deep_m, 1e-6 * again.stiffness_N_per_m);
  EXPECT_NEAR(again.rest_m, deep_m * 6.0 / 7.0, 1e-12);  // the imprint that stays

  ContactPoint deeper = Pressed(0.012);
  foot.Prepare(ground, Vec3::Zero(), 0.0, 0.001, deeper);  // beyond it the ground is fresh
  EXPECT_NEAR(SpringForce(deeper), CalcSinkageForce(ground, kRadius_m, 0.012), 1e-9);

  foot.Lift();
  ContactPoint fresh = Pressed(0.005);
  foot.Prepare(ground, {0.1, 0.0, 0.0}, 0.0, 0.001, fresh);  // a step further on
  EXPECT_EQ(fresh.rest_m, 0.0);
  EXPECT_NEAR(SpringForce(fresh), CalcSinkageForce(ground, kRadius_m, 0.005), 1e-9);
}

TEST(GroundLaw, ShearMobilisesFrictionAsJanosiSays) {
  const PlasticGround law;
  FootGround foot(law, kRadius_m, 4.0);
  const terrains::GroundSample ground = Uniform(3e6);
  constexpr double kNormal_N = 50.0;
  double j = 0.0;
  for (int i = 0; i < 40; ++i) {
    ContactPoint c = Pressed(0.005, kNormal_N);
    c.v_W = {0.5, 0.0, 0.0};
    foot.Finish(c, Vec3::Zero(), 0.001);
    j += 0.5e-3;
    foot.Prepare(ground, Vec3::Zero(), 0.0, 0.001, c);
    const double want_N =
        ground.friction * kNormal_N * (1.0 - std::exp(-j / law.shear_displacement_m));
    EXPECT_NEAR(c.shear_stiffness_N_per_m * c.shear_W.norm(), want_N, 1e-9);
  }
}

terrains::Heightfield FlatOf(double stiffness_N_per_m3, double friction = 0.8) {
  const terrains::Heightfield flat = test::FlatGround();
  return terrains::Heightfield(flat.nodes(), flat.resolution_m(), flat.heights_m(),
                               {.friction = friction, .stiffness_N_per_m3 = stiffness_N_per_m3});
}

// A robot that skids to a halt on plastic ground stays there: sheared ground gives back no more
// than a seventh of what it took.
TEST(GroundLaw, ShearedGroundDoesNotThrowTheFootBack) {
  const terrains::Heightfield ground = FlatOf(3e6, 0.3);
  PhysicsParams params;
  params.ground = PlasticGround{};
  Plant plant(test::Go2(), ground, params, kGravity);
  RobotState s = test::StandingState();
  const LegArray<Vec3> q = s.q;
  plant.Reset(s);
  for (int i = 0; i < 1500; ++i) plant.Step(Hold(plant.truth().state, q));
  s = plant.truth().state;
  s.v_WB.y() = 0.5;
  plant.Reset(s);
  const double start_J = 0.5 * plant.truth().mass_kg * 0.25;
  double least_J = start_J, rebound_J = 0.0;
  for (int i = 0; i < 2000; ++i) {
    plant.Step(Hold(plant.truth().state, q));
    const double along_J = 0.5 * plant.truth().mass_kg * std::pow(plant.truth().state.v_WB.y(), 2);
    least_J = std::min(least_J, along_J);
    rebound_J = std::max(rebound_J, along_J - least_J);
  }
  EXPECT_LT(rebound_J, 0.2 * start_J);
  EXPECT_LT(std::abs(plant.truth().state.v_WB.y()), 1e-3);
}

// Feet sink deeper than their own diameter and still carry the robot.
TEST(GroundLaw, VerySoftGroundStillCarries) {
  for (const auto& [k_s, drop_m] : {std::pair{4e5, 0.0}, {8.9e5, 0.1}, {1.5e6, 0.3}}) {
    const terrains::Heightfield ground = FlatOf(k_s);
    Plant plant(test::Go2(), ground, {}, kGravity);
    RobotState s = test::StandingState();
    const LegArray<Vec3> q = s.q;
    s.p_WB.z() += drop_m;
    plant.Reset(s);
    for (int i = 0; i < 4000; ++i) plant.Step(Hold(plant.truth().state, q));
    double sum_N = 0.0;
    for (const Leg leg : kLegs) sum_N += plant.truth().f_F_W[leg].z();
    EXPECT_NEAR(sum_N, plant.truth().mass_kg * 9.81, 0.5) << k_s;
  }
}

TEST(GroundLaw, GroundContinuesBeyondItsTile) {
  const terrains::Heightfield ground = test::FlatGround(0.8, 4.0);
  Plant plant(test::Go2(), ground, {}, kGravity);
  RobotState s = test::StandingState();
  s.p_WB.x() = 10.0;
  plant.Reset(s);
  for (int i = 0; i < 2000; ++i) plant.Step(Hold(plant.truth().state, s.q));
  EXPECT_GT(plant.truth().state.p_WB.z(), 0.25);
}

/// Largest change of one foot's normal force from step to step of a robot that slides with locked
/// legs down tilted gravity, after it has settled.
double LargestKick(const terrains::Heightfield& ground, double slope) {
  Plant plant(test::Go2(), ground, {}, 9.81 * Vec3(-std::sin(slope), 0.0, -std::cos(slope)));
  const RobotState start = test::StandingState();
  plant.Reset(start);
  double before_N = 0.0, kick_N = 0.0;
  for (int i = 0; i < 2000; ++i) {
    plant.Step(Hold(plant.truth().state, start.q));
    const double now_N = plant.truth().f_normal_N[Leg::kFL];
    if (i > 800) kick_N = std::max(kick_N, std::abs(now_N - before_N));
    before_N = now_N;
  }
  EXPECT_LT(plant.truth().state.p_WB.x(), -0.5) << "it does slide";
  EXPECT_LT(plant.truth().state.p_WB.norm(), 9.0) << "and stays on the tile";
  return kick_N;
}

// Fifteen kilogrammes press with 37 N on each foot.
TEST(GroundLaw, SlidingOverEveryCellAndMaterialEdgeGivesNoKick) {
  constexpr int kNodes = 800;
  constexpr double kSpacing_m = 0.025;
  const auto make = [&](auto height, auto share) {
    std::vector<double> heights;
    terrains::Cover soft{
        {.name = "ash", .friction = 0.15, .stiffness_N_per_m3 = 3e6, .depth_m = 0.05}, {}};
    for (int row = 0; row < kNodes; ++row) {
      for (int column = 0; column < kNodes; ++column) {
        heights.push_back(height((column - 400) * kSpacing_m, (row - 400) * kSpacing_m));
        soft.share.push_back(share(column, row));
      }
    }
    return terrains::Heightfield(kNodes, kSpacing_m, std::move(heights), {.friction = 0.2},
                                 {std::move(soft)});
  };
  const auto flat = [](double, double) { return 0.0; };
  const auto tilted = [](double x, double y) { return 0.1 * x - 0.05 * y; };
  const auto waves = [](double x, double y) {
    return 0.004 * std::sin(12.0 * x) * std::cos(9.0 * y);
  };
  const auto hard = [](int, int) { return std::uint8_t{0}; };
  // Shares rise over 0.2 m, as the generator blends them.
  const auto stripes = [](int column, int) {
    const double phase = std::abs(std::remainder(column * kSpacing_m, 1.0)) / 0.5;  // 0 .. 1
    return static_cast<std::uint8_t>(255.0 * std::clamp(2.5 * (phase - 0.3), 0.0, 1.0));
  };
  EXPECT_LT(LargestKick(make(flat, hard), 0.35), 0.01);
  EXPECT_LT(LargestKick(make(tilted, hard), 0.35), 0.05);
  EXPECT_LT(LargestKick(make(waves, hard), 0.35), 2.0);
  EXPECT_LT(LargestKick(make(flat, stripes), 0.23), 4.0);
  // The edge of a rock on soft ground rises over three nodes: there the foot climbs out of a
  // centimetre of ash within 5 cm.
  const auto rocks = [](int column, int) {
    const double from_edge = std::abs(std::remainder(column, 40.0)) - 10.0;  // nodes
    return static_cast<std::uint8_t>(255.0 * std::clamp(0.5 + from_edge / 3.0, 0.0, 1.0));
  };
  EXPECT_LT(LargestKick(make(flat, rocks), 0.23), 10.0);
}

}  // namespace
}  // namespace scoria::sim
