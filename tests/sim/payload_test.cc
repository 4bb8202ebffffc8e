// SPDX-License-Identifier: BSD-3-Clause
#include "sim/payload.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "sim/plant/plant.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

/// A walk without a break.
core::EventClock At(double time_s, double walked_m) { return {time_s, walked_m, time_s}; }

const Vec3 kGravity_W(0.0, 0.0, -9.81);

SpatialInertia BareTrunk() { return test::Go2().trunk; }

PayloadParams Plate() {
  return {"plate", 5.0, {0.02, 0.05, 0.09}, {0.1, 0.2, 0.3}, {0.2, 0.2, 0.02}};
}

PayloadEvent AddAt(double at_s, const PayloadParams& body) {
  PayloadEvent e;
  e.at_s = at_s;
  e.body = body;
  return e;
}

PayloadEvent EventAt(double at_s, PayloadAction action, const std::string& payload) {
  PayloadEvent e;
  e.at_s = at_s;
  e.action = action;
  e.payload = payload;
  return e;
}

/// Whether one change comes, to the bare trunk with that body.
::testing::AssertionResult LoadsWith(const SpatialInertia& body,
                                     const std::vector<TrunkChange>& changes) {
  if (changes.size() != 1)
    return ::testing::AssertionFailure() << changes.size() << " changes instead of one";
  const SpatialInertia& trunk = changes[0].trunk;
  const SpatialInertia wanted = AddBodies(BareTrunk(), std::vector<SpatialInertia>{body});
  const double mass_kg = std::abs(trunk.mass_kg - wanted.mass_kg);
  const double place_m = (trunk.p_OC - wanted.p_OC).norm();
  const double inertia_kgm2 = (trunk.I_C - wanted.I_C).norm();
  if (std::max({mass_kg, place_m, inertia_kgm2}) < 1e-14) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "off by " << mass_kg << " kg, " << place_m << " m, " << inertia_kgm2 << " kg m^2";
}

/// Roll, pitch, yaw half-way of the shortest turn between two others.
Vec3 HalfTurn(const Vec3& from_rpy_rad, const Vec3& to_rpy_rad) {
  const Mat3 from = core::RotationFromRpy(from_rpy_rad), to = core::RotationFromRpy(to_rpy_rad);
  return core::RpyFromRotation(core::ExpSo3(0.5 * core::LogSo3(to * from.transpose())) * from);
}

/// A share of a body, in its place.
SpatialInertia Share(double share, const SpatialInertia& whole) {
  return {share * whole.mass_kg, whole.p_OC, share * whole.I_C};
}

LegArray<Vec3> HoldSoftly(const RobotState& s, const LegArray<Vec3>& q) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (const Leg leg : kLegs) tau[leg] = 200.0 * (q[leg] - s.q[leg]) - 5.0 * s.qd[leg];
  return tau;
}

/// Linear momentum, and angular momentum about W's origin, of the robot with a trunk.
Vec6 RobotMomentum(const SpatialInertia& trunk, const RobotState& state) {
  core::WholeBodyModel model(test::Go2(), Vec3::Zero());
  model.SetParameters({trunk});
  core::WholeBody wb;
  model.Calc(state, wb);
  Vec6 out = CalcMomentum(wb);
  out.tail<3>() += wb.p_WC.cross(out.head<3>());
  return out;
}

/// Of a body that moves with the trunk.
Vec6 Momentum(const SpatialInertia& body, const RobotState& s) {
  const Vec3 r_W = s.R_WB * body.p_OC;
  const Vec3 p_W = body.mass_kg * (s.v_WB + s.w_WB.cross(r_W));
  Vec6 out;
  out << p_W, (s.p_WB + r_W).cross(p_W) + s.R_WB * body.I_C * s.R_WB.transpose() * s.w_WB;
  return out;
}

TEST(Payload, CompositionEqualsAHandCalculation) {
  const SpatialInertia trunk{3.0, {0.1, 0.0, 0.0}, Vec3(1.0, 2.0, 3.0).asDiagonal()};
  const std::vector<SpatialInertia> point = {{1.0, {0.5, 0.0, 0.4}}};
  const SpatialInertia sum = AddBodies(trunk, point);
  EXPECT_DOUBLE_EQ(sum.mass_kg, 4.0);
  EXPECT_LT((sum.p_OC - Vec3(0.2, 0.0, 0.1)).norm(), 1e-15);
  Mat3 I;
  I << 1.12, 0.0, -0.12, 0.0, 2.24, 0.0, -0.12, 0.0, 3.12;
  EXPECT_LT((sum.I_C - I).norm(), 1e-14);
  EXPECT_EQ(AddBodies(trunk, {}), trunk);
  EXPECT_EQ(AddBodies(trunk, std::vector<SpatialInertia>{{0.0, {0.5, 0.0, 0.4}}}), trunk);
}

TEST(Payload, InertiaIsTheBoxsOrAsGivenAndTurnsWithIt) {
  PayloadParams p{"box", 12.0, Vec3::Zero(), {0.0, 0.0, std::numbers::pi / 2}, {1.0, 2.0, 3.0}};
  const Mat3 box = Vec3(10.0, 13.0, 5.0).asDiagonal();
  EXPECT_LT((ToInertia(p).I_C - box).norm(), 1e-13);
  p.inertia_kgm2 = {4.0, 5.0, 6.0};
  const Mat3 given = Vec3(5.0, 4.0, 6.0).asDiagonal();
  EXPECT_LT((ToInertia(p).I_C - given).norm(), 1e-13);
  EXPECT_EQ(ToInertia({"point", 2.0}).I_C, Mat3::Zero());
}

TEST(Payload, MomentumIsConservedWhereTheBodyWasAtRest) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, Vec3::Zero());
  core::Rng rng(31, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 20; ++trial) {
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    plant.SetTrunkParameters(BareTrunk(), AttachVelocity::kMatched);
    plant.Reset(s);
    plant.Step(ZeroPerLeg());
    const Truth before = plant.truth();
    PayloadEvent add = AddAt(0.0, Plate());
    add.attach_velocity = AttachVelocity::kRest;
    PayloadRack rack(BareTrunk(), {add});
    const std::vector<TrunkChange> changes = rack.Update(At(0.1, 0.0));
    ASSERT_EQ(changes.size(), 1u);
    plant.SetTrunkParameters(changes[0].trunk, changes[0].attach_velocity);
    const Truth& after = plant.truth();
    const Vec6 P = RobotMomentum(before.trunk, before.state),
               Q = RobotMomentum(after.trunk, after.state);
    EXPECT_LT((Q - P).head<3>().norm(), 1e-9 * P.head<3>().norm()) << trial;
    EXPECT_LT((Q - P).tail<3>().norm(), 1e-9 * P.tail<3>().norm()) << trial;
    EXPECT_LT(after.energy.kinetic_J, before.energy.kinetic_J) << "a plastic impact";
    EXPECT_NEAR(after.energy.Error_J(), before.energy.Error_J(), 1e-9);
  }
}

TEST(Payload, MatchedBodyBringsAndTakesItsOwnMomentum) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, Vec3::Zero());
  core::Rng rng(32, 0, core::Stream::kSensor);
  const SpatialInertia plate = ToInertia(Plate());
  for (int trial = 0; trial < 20; ++trial) {
    PayloadRack rack(BareTrunk(),
                     {AddAt(0.0, Plate()), EventAt(1.0, PayloadAction::kRemove, "plate")});
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    plant.Reset(s);
    const Vec6 bare = RobotMomentum(BareTrunk(), s);
    plant.SetTrunkParameters(rack.Update(At(0.1, 0.0)).at(0).trunk, AttachVelocity::kMatched);
    EXPECT_EQ(plant.truth().state, s);
    const Vec6 loaded = RobotMomentum(plant.truth().trunk, s), own = Momentum(plate, s);
    EXPECT_LT((loaded - bare - own).head<3>().norm(), 1e-9 * loaded.head<3>().norm()) << trial;
    EXPECT_LT((loaded - bare - own).tail<3>().norm(), 1e-9 * loaded.tail<3>().norm()) << trial;
    plant.SetTrunkParameters(rack.Update(At(1.1, 0.0)).at(0).trunk, AttachVelocity::kMatched);
    EXPECT_EQ(RobotMomentum(plant.truth().trunk, plant.truth().state), bare);
  }
}

TEST(Payload, ImpactShowsInTheNextStepsAcceleration) {
  const terrains::Heightfield ground = test::FlatGround();
  const PhysicsParams params;
  Plant plant(test::Go2(), ground, params, Vec3::Zero());
  RobotState s = test::StandingState();
  s.p_WB.z() = 5.0;
  s.v_WB = {1.0, 0.0, 0.0};
  plant.Reset(s);
  plant.SetTrunkParameters(AddBodies(BareTrunk(), std::vector<SpatialInertia>{ToInertia(Plate())}),
                           AttachVelocity::kRest);
  plant.Step(ZeroPerLeg());
  const Truth& t = plant.truth();
  EXPECT_LT(t.state.v_WB.x(), 0.9);
  EXPECT_LT((t.a_WB * params.step_s - (t.state.v_WB - s.v_WB)).norm(), 1e-12);
  plant.Step(ZeroPerLeg());
  EXPECT_GT(plant.truth().a_WB.x() * params.step_s, -0.01);
}

TEST(PayloadRack, AddedThenRemovedRestoresTheTrunkBitForBit) {
  const PayloadParams kit{"kit", 1.19, {0.0137, -0.021, 0.11}, {0.3, 0.1, 0.7}, {0.18, 0.14, 0.06}};
  PayloadEvent slow = AddAt(2.0, kit), shed = EventAt(4.0, PayloadAction::kShed, "plate");
  slow.duration_s = 0.7;
  shed.share = 0.3;
  PayloadEvent gone = EventAt(6.0, PayloadAction::kRemove, "plate");
  gone.duration_s = 0.37;
  PayloadRack rack(BareTrunk(), {AddAt(1.0, Plate()), slow, shed, gone,
                                 EventAt(7.0, PayloadAction::kRemove, "kit")});
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, kGravity_W);
  const SpatialInertia before = plant.truth().trunk;
  int changes = 0;
  for (int i = 0; i < 8000; ++i) {
    for (const TrunkChange& change : rack.Update(At(0.001 * i, 0.0))) {
      plant.SetTrunkParameters(change.trunk, change.attach_velocity);
      ++changes;
    }
    const SpatialInertia& now = plant.truth().trunk;
    if (i == 1500) {
      EXPECT_EQ(now, AddBodies(BareTrunk(), std::vector<SpatialInertia>{ToInertia(Plate())}));
    }
    if (i == 6500) {
      EXPECT_EQ(now, AddBodies(BareTrunk(), std::vector<SpatialInertia>{ToInertia(kit)}));
    }
  }
  EXPECT_GT(changes, 1000);
  EXPECT_EQ(before, BareTrunk());
  EXPECT_EQ(plant.truth().trunk, before);
}

TEST(PayloadRack, AllOffIsTheBareTrunkForGood) {
  PayloadEvent slow =
      AddAt(1.0, {"kit", 1.19, {0.0137, -0.021, 0.11}, {0.0, 0.0, 0.0}, {0.18, 0.14, 0.06}});
  slow.duration_s = 2.0;
  PayloadRack rack(BareTrunk(), {AddAt(0.5, Plate()), slow, AddAt(4.0, {"late", 1.0})});
  EXPECT_EQ(rack.RemoveAll(), std::nullopt) << "nothing is on the trunk";
  rack = PayloadRack(BareTrunk(), {AddAt(0.5, Plate()), slow, AddAt(4.0, {"late", 1.0})});
  (void)rack.Update(At(2.0, 0.0));
  EXPECT_EQ(rack.RemoveAll(), (TrunkChange{BareTrunk(), AttachVelocity::kMatched}));
  EXPECT_TRUE(rack.Update(At(2.5, 0.0)).empty()) << "the kit is added no further";
  EXPECT_TRUE(rack.Update(At(5.0, 0.0)).empty()) << "what is still to come is called off";
  EXPECT_TRUE(rack.announcements().empty());
  EXPECT_EQ(rack.RemoveAll(), std::nullopt);
}

TEST(PayloadRack, GradualEventsRunOnTheClock) {
  PayloadEvent add = AddAt(1.0, Plate());
  add.duration_s = 4.0;
  PayloadRack rack(BareTrunk(), {add});
  EXPECT_TRUE(rack.Update(At(1.0, 0.0)).empty());
  EXPECT_TRUE(rack.announcements().empty());
  const SpatialInertia plate = ToInertia(Plate());
  EXPECT_TRUE(LoadsWith(Share(0.25, plate), rack.Update(At(2.0, 0.0))));
  ASSERT_EQ(rack.announcements().size(), 1u);
  EXPECT_EQ(rack.announcements()[0],
            "payload plate added over 4 s: 5 kg at (0.020, 0.050, 0.090) m");
  EXPECT_TRUE(rack.Update(At(2.0, 0.0)).empty()) << "no time has gone by";
  EXPECT_TRUE(rack.announcements().empty());
  EXPECT_TRUE(LoadsWith(plate, rack.Update(At(5.0, 0.0))));
  EXPECT_TRUE(rack.Update(At(9.0, 0.0)).empty());
}

TEST(PayloadRack, EventsBeginAtADistance) {
  PayloadEvent add = AddAt(0.0, Plate());
  add.at_s.reset();
  add.distance_m = 3.0;
  add.duration_s = 2.0;
  PayloadRack rack(BareTrunk(), {add});
  EXPECT_TRUE(rack.Update(At(50.0, 2.9)).empty());
  EXPECT_TRUE(rack.Update(At(60.0, 3.1)).empty()) << "it begins with nothing";
  EXPECT_EQ(rack.announcements().size(), 1u);
  EXPECT_TRUE(LoadsWith(Share(0.5, ToInertia(Plate())), rack.Update(At(61.0, 3.2))));
}

TEST(PayloadRack, MovedBodyGoesStraightAndTurns) {
  PayloadEvent move = EventAt(1.0, PayloadAction::kMove, "plate");
  move.p_BP_m = Vec3(0.02, -0.15, 0.09);
  move.rpy_rad = Vec3(0.0, 0.0, 1.2);
  move.duration_s = 2.0;
  PayloadRack rack(BareTrunk(), {AddAt(0.0, Plate()), move});
  EXPECT_TRUE(LoadsWith(ToInertia(Plate()), rack.Update(At(0.5, 0.0))));
  PayloadParams half_way = Plate();
  half_way.p_BP_m = {0.02, -0.05, 0.09};
  half_way.rpy_rad = HalfTurn(Plate().rpy_rad, *move.rpy_rad);
  EXPECT_TRUE(LoadsWith(ToInertia(half_way), rack.Update(At(2.0, 0.0))));
  EXPECT_EQ(rack.announcements().at(0),
            "payload plate moved over 2 s: 5 kg to (0.020, -0.150, 0.090) m");
  PayloadParams there = Plate();
  there.p_BP_m = *move.p_BP_m;
  there.rpy_rad = *move.rpy_rad;
  EXPECT_TRUE(LoadsWith(ToInertia(there), rack.Update(At(4.0, 0.0))));
}

TEST(PayloadRack, ShedBodyKeepsTheRestInItsPlace) {
  PayloadEvent shed = EventAt(1.0, PayloadAction::kShed, "plate");
  shed.share = 0.4;
  PayloadRack rack(BareTrunk(), {AddAt(0.0, Plate()), shed});
  (void)rack.Update(At(0.5, 0.0));
  EXPECT_TRUE(LoadsWith(Share(0.6, ToInertia(Plate())), rack.Update(At(1.5, 0.0))));
  EXPECT_EQ(rack.announcements().at(0),
            "payload plate loses a part: 2 of 5 kg at (0.020, 0.050, 0.090) m");
}

TEST(PayloadRack, MatchedAndRestedBodiesInOneStepAreTwoChanges) {
  PayloadParams other = Plate();
  other.name = "other";
  PayloadEvent rested = AddAt(1.0, Plate());
  rested.attach_velocity = AttachVelocity::kRest;
  PayloadRack rack(BareTrunk(), {rested, AddAt(1.0, other)});
  const std::vector<TrunkChange> changes = rack.Update(At(1.5, 0.0));
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].attach_velocity, AttachVelocity::kMatched);
  EXPECT_EQ(changes[0].trunk,
            AddBodies(BareTrunk(), std::vector<SpatialInertia>{ToInertia(other)}));
  EXPECT_EQ(changes[1].attach_velocity, AttachVelocity::kRest);
  EXPECT_EQ(changes[1].trunk, AddBodies(BareTrunk(), std::vector<SpatialInertia>{
                                                         ToInertia(Plate()), ToInertia(other)}));
}

TEST(PayloadRack, EventWithoutItsBodyDoesNothingAndSaysSo) {
  PayloadRack rack(BareTrunk(), {EventAt(1.0, PayloadAction::kRemove, "plate"), AddAt(2.0, Plate()),
                                 AddAt(3.0, Plate())});
  EXPECT_TRUE(rack.Update(At(1.5, 0.0)).empty());
  EXPECT_EQ(rack.announcements().at(0), "payload plate: nothing to remove, it is not on the trunk");
  EXPECT_EQ(rack.Update(At(2.5, 0.0)).size(), 1u);
  EXPECT_TRUE(rack.Update(At(3.5, 0.0)).empty());
  EXPECT_EQ(rack.announcements().at(0), "payload plate not added: it is on the trunk");
}

TEST(PayloadEvent, MistakesAreNamed) {
  using enum PayloadAction;
  EXPECT_EQ(AddAt(0.0, Plate()).Problem(), "");
  PayloadEvent e = AddAt(0.0, Plate());
  e.distance_m = 3.0;
  EXPECT_EQ(e.Problem(), "needs one of at_s and distance_m");
  e.at_s.reset();
  EXPECT_EQ(e.Problem(), "");
  e.distance_m.reset();
  EXPECT_EQ(e.Problem(), "needs one of at_s and distance_m");
  e = AddAt(0.0, Plate());
  e.share = 0.5;
  EXPECT_EQ(e.Problem(), "share: add has none");
  e = AddAt(0.0, Plate());
  e.payload = "plate";
  EXPECT_EQ(e.Problem(), "payload: add has none");
  e.body.reset();
  EXPECT_EQ(e.Problem(), "body: add needs one");
  EXPECT_EQ(EventAt(0.0, kRemove, "").Problem(), "payload: remove needs the name of one");
  EXPECT_EQ(EventAt(0.0, kMove, "plate").Problem(), "move needs p_BP_m, rpy_rad or both");
  EXPECT_EQ(EventAt(0.0, kShed, "plate").Problem(),
            "share: shed needs one in (0, 1); remove takes all");
  e = EventAt(0.0, kRemove, "plate");
  e.p_BP_m = Vec3::Zero();
  EXPECT_EQ(e.Problem(), "p_BP_m: remove has none");
  e = EventAt(0.0, kRemove, "plate");
  e.attach_velocity = AttachVelocity::kRest;
  EXPECT_EQ(e.Problem(),
            "attach_velocity: rest is for add; what remove concerns moves with the trunk");
  const std::vector<PayloadEvent> strange = {AddAt(0.0, Plate()), EventAt(1.0, kRemove, "plat")};
  EXPECT_EQ(PayloadProblem(strange), "payload: nothing adds \"plat\"; added: plate");
  EXPECT_EQ(PayloadProblem(std::span(strange).first(1)), "");
  EXPECT_EQ(PayloadProblem(std::span(strange).last(1)),
            "payload: nothing adds \"plat\"; added: none");
}

TEST(PayloadParams, MistakesAreNamed) {
  const auto error = [](const std::string& yaml) -> std::string {
    try {
      (void)core::ReadConfig<PayloadParams>(core::ParseConfig(yaml, "p.yaml"));
    } catch (const core::ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error("{name: a, mass_kg: 1}"), "");
  EXPECT_NE(error("{name: a}").find("mass_kg: is missing and has no default"), std::string::npos);
  EXPECT_NE(error("{name: a, mass_kg: 0}").find("mass_kg: 0 is outside [0.001, 50]"),
            std::string::npos)
      << error("{name: a, mass_kg: 0}");
  EXPECT_NE(error("{name: '', mass_kg: 1}").find("name: must not be empty"), std::string::npos);
  EXPECT_NE(error("{name: a, mass_kg: 1, size_m: [0.1, 0, 0.1]}")
                .find("size_m: either all edges are 0 or none"),
            std::string::npos);
  EXPECT_NE(error("{name: a, mass_kg: 1, inertia_kgm2: [1, 1, 3]}")
                .find("inertia_kgm2: no body has a moment greater than the sum of the other two"),
            std::string::npos);
}

TEST(PayloadEvent, IsReadAndWrittenBack) {
  const auto event = core::ReadConfig<PayloadEvent>(core::ParseConfig(
      "{distance_m: 5, action: add, attach_velocity: rest, duration_s: 2, body: {name: rock, "
      "mass_kg: 0.8, p_BP_m: [0, 0.1, 0.1]}}",
      "e.yaml"));
  EXPECT_EQ(event.name(), "rock");
  EXPECT_EQ(event.attach_velocity, AttachVelocity::kRest);
  EXPECT_EQ(core::ReadConfig<PayloadEvent>(core::WriteConfig(event)), event);
}

TEST(PayloadLibrary, FilesHaveTheMassTheirNameSays) {
  const std::vector<std::pair<std::string, double>> masses = {
      {"plate_1_25kg", 1.25}, {"plate_2_5kg", 2.5},     {"plate_5kg", 5.0},
      {"field_kit", 1.19},    {"sample_canister", 2.0}, {"instrument_off_centre", 5.0}};
  for (const auto& [name, mass_kg] : masses) {
    const auto payload = core::ReadConfig<PayloadParams>(
        core::LoadConfig(test::SourcePath("robots/payloads/" + name + ".yaml")));
    EXPECT_EQ(payload.name, name);
    EXPECT_EQ(payload.mass_kg, mass_kg);
    EXPECT_GT(ToInertia(payload).I_C.trace(), 0.0) << name;
  }
}

TEST(Plant, StandsUnderAPlateThatIsPutOnItsBack) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, kGravity_W);
  const RobotState start = test::StandingState();
  plant.Reset(start);
  PayloadEvent add = AddAt(1.0, Plate());
  add.attach_velocity = AttachVelocity::kRest;
  PayloadRack rack(BareTrunk(), {add});
  double worst_J = 0.0;
  for (int i = 0; i < 4000; ++i) {
    for (const TrunkChange& change : rack.Update(At(0.001 * i, 0.0)))
      plant.SetTrunkParameters(change.trunk, change.attach_velocity);
    plant.Step(HoldSoftly(plant.truth().state, start.q));
    worst_J = std::max(worst_J, std::abs(plant.truth().energy.Error_J()));
  }
  const Truth& t = plant.truth();
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += t.f_F_W[leg];
  EXPECT_DOUBLE_EQ(t.mass_kg, test::Go2().total_mass_kg() + 5.0);
  EXPECT_NEAR(sum.z(), t.mass_kg * 9.81, 0.05);
  EXPECT_NEAR(sum.head<2>().norm(), 0.0, 0.05);
  EXPECT_NEAR(t.energy.work.external_J, 20.0, 1.0) << "m g z of the plate";
  EXPECT_LT(worst_J, 1e-4);
}

TEST(Plant, ResetKeepsThePayload) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, kGravity_W);
  const std::vector<SpatialInertia> plate = {ToInertia(Plate())};
  plant.SetTrunkParameters(AddBodies(BareTrunk(), plate), AttachVelocity::kMatched);
  plant.Reset(test::StandingState());
  EXPECT_DOUBLE_EQ(plant.truth().mass_kg, test::Go2().total_mass_kg() + 5.0);
  EXPECT_EQ(plant.truth().energy.Error_J(), 0.0);
}

SlidingPayloadParams Block() { return {"block", 2.0, {0.0, 0.0, 0.1}, Vec3::UnitY(), 300.0, 4.0}; }

TEST(SlidingPayload, ComesToRestOnAStandingRobotAndIsCarried) {
  const terrains::Heightfield ground = test::FlatGround();
  const double tilt = 0.1;  // gravity to the left
  Plant plant(test::Go2(), ground, {}, 9.81 * Vec3(0.0, std::sin(tilt), -std::cos(tilt)), Block());
  const RobotState start = test::StandingState();
  plant.Reset(start);
  double worst_J = 0.0, widest_m = 0.0;
  for (int i = 0; i < 12000; ++i) {
    plant.Step(HoldSoftly(plant.truth().state, start.q));
    worst_J = std::max(worst_J, std::abs(plant.truth().energy.Error_J()));
    widest_m = std::max(widest_m, plant.truth().slide_m);
  }
  const Truth& t = plant.truth();
  const double roll = core::RpyFromRotation(t.state.R_WB).x();
  const double pull_N = 2.0 * 9.81 * std::sin(tilt - roll);
  EXPECT_NEAR(t.slide_m, pull_N / 300.0, 1e-5);
  EXPECT_GT(widest_m, 1.3 * t.slide_m) << "it swings";
  EXPECT_LT(std::abs(t.slide_mps), 1e-4);
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += t.f_F_W[leg];
  EXPECT_NEAR(sum.norm(), (test::Go2().total_mass_kg() + 2.0) * 9.81, 0.1);
  EXPECT_LT(worst_J, 1e-4);
}

TEST(SlidingPayload, MomentumIsKeptInFlightAndInAnImpact) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, Vec3::Zero(), Block());
  RobotState s = test::StandingState();
  s.p_WB.z() = 5.0;
  s.v_WB = {0.5, 1.0, 0.2};
  s.w_WB = {0.5, -0.4, 0.8};
  plant.Reset(s);
  const auto momentum = [&] {
    const Truth& t = plant.truth();
    const Vec3 u_W = t.state.R_WB * Vec3::UnitY();
    SpatialInertia block{2.0, Vec3(0.0, t.slide_m, 0.1)};
    Vec6 own;
    own << 2.0 * t.slide_mps * u_W,
        (t.state.p_WB + t.state.R_WB * block.p_OC).cross(2.0 * t.slide_mps * u_W);
    return Vec6(RobotMomentum(t.trunk, t.state) + Momentum(block, t.state) + own);
  };
  const Vec6 start = momentum();
  for (int i = 0; i < 500; ++i) plant.Step(HoldSoftly(plant.truth().state, s.q));
  const Vec6 flown = momentum();
  // First order in the step, as without it.
  EXPECT_LT((flown - start).head<3>().norm(), 1e-3 * start.head<3>().norm());
  EXPECT_LT((flown - start).tail<3>().norm(), 1e-3 * start.tail<3>().norm());
  EXPECT_LT(std::abs(plant.truth().energy.Error_J()), 0.002 * plant.truth().energy.initial_J);
  EXPECT_GT(std::abs(plant.truth().slide_mps), 1e-4);
  const double rate_mps = plant.truth().slide_mps;
  plant.SetTrunkParameters(AddBodies(BareTrunk(), std::vector<SpatialInertia>{ToInertia(Plate())}),
                           AttachVelocity::kRest);
  const Vec6 hit = momentum();
  EXPECT_LT((hit - flown).head<3>().norm(), 1e-9 * flown.head<3>().norm());
  EXPECT_LT((hit - flown).tail<3>().norm(), 1e-9 * flown.tail<3>().norm());
  EXPECT_GT(std::abs(plant.truth().slide_mps - rate_mps), 0.05) << "it shoots forth";
}

// The robot flies on as one that never had it, from the state in which it lost it.
TEST(SlidingPayload, TakenOffLeavesTheRobotItsVelocity) {
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(test::Go2(), ground, {}, kGravity_W, Block()),
      bare(test::Go2(), ground, {}, kGravity_W);
  RobotState s = test::StandingState();
  s.p_WB.z() = 5.0;
  s.v_WB = {0.5, 1.0, 0.2};
  s.w_WB = {0.5, -0.4, 0.8};
  plant.Reset(s);
  for (int i = 0; i < 200; ++i) plant.Step(HoldSoftly(plant.truth().state, s.q));
  const Truth before = plant.truth();
  ASSERT_NE(before.slide_mps, 0.0);
  plant.RemoveSlidingPayload();
  EXPECT_EQ(plant.truth().state, before.state);
  EXPECT_DOUBLE_EQ(plant.truth().mass_kg, test::Go2().total_mass_kg());
  EXPECT_EQ(plant.truth().slide_m, 0.0);
  EXPECT_EQ(plant.truth().slide_mps, 0.0);
  EXPECT_NEAR(plant.truth().energy.Error_J(), before.energy.Error_J(), 1e-9);
  bare.Reset(before.state);
  for (int i = 0; i < 100; ++i) {
    for (Plant* w : {&plant, &bare}) w->Step(HoldSoftly(w->truth().state, s.q));
  }
  EXPECT_LT((plant.truth().state.p_WB - bare.truth().state.p_WB).norm(), 1e-6);
  EXPECT_LT((plant.truth().state.w_WB - bare.truth().state.w_WB).norm(), 1e-6);
  plant.RemoveSlidingPayload();
  EXPECT_EQ(plant.truth().mass_kg, bare.truth().mass_kg);
}

TEST(SlidingPayload, MistakesAreNamed) {
  SlidingPayloadParams p = Block();
  EXPECT_EQ(p.Problem(), "");
  p.stiffness_N_per_m = 2e5;
  EXPECT_EQ(p.Problem(), "stiffness_N_per_m: the step resolves at most 125000 with this mass");
  p.axis = Vec3::Zero();
  EXPECT_EQ(p.Problem(), "axis: must not be zero");
  p.name = "";
  EXPECT_EQ(p.Problem(), "name: must not be empty");
}

}  // namespace
}  // namespace scoria::sim
