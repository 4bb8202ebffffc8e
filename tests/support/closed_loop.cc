// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/closed_loop.h"

#include "sim/true_ground.h"
#include "tests/support/motion.h"
#include "tests/support/robots.h"

namespace scoria::test {
namespace {

const Vec3 kGravity_W(0.0, 0.0, -kGravity_mps2);
constexpr std::uint64_t kSeed = 5;

controller::Start StartIn(controller::Start::Pose pose) {
  controller::Start start;
  start.pose = pose;
  return start;
}

}  // namespace

ClosedLoop::ClosedLoop(const LoopParams& params, const core::RobotDescription& robot,
                       const terrains::Heightfield& ground)
    : plant(robot, ground, params.physics, kGravity_W, params.sliding),
      payloads(plant.truth().trunk, params.payloads),
      actuation(robot),
      sensors(robot, params.sensors, params.sensor_faults, kGravity_W, kStep_s, kSeed),
      controller(params.controller, robot, kGravity_mps2, kStep_s, StartIn(params.pose)),
      ground_(ground),
      params_(params),
      fault_rng_(kSeed, 0, core::Stream::kSolverFault) {
  RobotState state = StandingState();
  if (params.pose == controller::Start::Pose::kLying) {
    for (const Leg leg : kLegs) state.q[leg] = {0.0, 1.3, -2.7};
    state.p_WB.z() = 0.1;
  }
  state.p_WB.z() += ground.HeightAt(0.0, 0.0);
  plant.Reset(state);
}

void ClosedLoop::Step() {
  const double time_s = step_ * kStep_s;
  const core::EventClock now{time_s, 0.0, time_s};
  const SensorFrame z = sensors.Read(plant.truth(), actuation.motor_tau_Nm(), step_, now, true);
  constexpr double kStands_s = 0.5;
  const Command command = time_s < kStands_s ? Command{} : walk;
  controller::SolverFaults faults;
  if (fault_rng_.NextUniform() < params_.fault_share) faults.mpc = controller::SolverFault::kLate;
  if (fault_rng_.NextUniform() < params_.fault_share) faults.wbc = controller::SolverFault::kFail;
  const sim::TrueGround true_ground(ground_, plant.truth().state);
  controller::TrueInputs true_inputs = CollectTrueInputs(z);
  if (substitute.ground) true_inputs.ground = &true_ground;
  control_ = controller.Step(z, command, faults, true_inputs);
  for (const sim::TrunkChange& change : payloads.Update(now))
    plant.SetTrunkParameters(change.trunk, change.attach_velocity);
  const LegArray<Vec3> qd_before = plant.truth().state.qd;
  plant.Step(actuation.Update(control_.command, {z.q, z.qd}, qd_before, kStep_s));
  actuation.Meter(qd_before, plant.truth().state.qd, kStep_s);
  Add(z);
  ++step_;
}

controller::TrueInputs ClosedLoop::CollectTrueInputs(const SensorFrame& z) const {
  controller::TrueInputs inputs;
  if (substitute.state) inputs.state = z.truth->state;
  if (substitute.contact) inputs.contact = z.truth->contact;
  if (substitute.trunk) inputs.trunk = core::ModelParameters{plant.truth().trunk};
  return inputs;
}

void ClosedLoop::Run(int steps) {
  for (int i = 0; i < steps; ++i) Step();
}

void ClosedLoop::Add(const SensorFrame& z) {
  const auto add_legs = [this](const LegArray<Vec3>& v) {
    hash_.Add(Flatten(v).data(), kNumJoints);
  };
  const auto add_state = [&](const RobotState& s) {
    hash_.Add(s.p_WB.data(), 3);
    hash_.Add(s.R_WB.data(), 9);
    hash_.Add(s.v_WB.data(), 3);
    hash_.Add(s.w_WB.data(), 3);
    add_legs(s.q);
    add_legs(s.qd);
  };
  const sim::Truth& truth = plant.truth();
  add_state(truth.state);
  add_legs(truth.f_F_W);
  add_legs(z.q);
  add_legs(z.tau_Nm);
  hash_.Add(z.a_WS_S.data(), 3);
  hash_.Add(z.foot_force_raw.begin(), kNumLegs);
  add_state(control_.estimate.state);
  hash_.Add(control_.estimate.P_tilt_v.data(), 25);
  hash_.Add(control_.adaptation.P.data(), 9);
  hash_.Add(control_.contact.observer_probability.begin(), kNumLegs);
  add_legs(control_.command.tau_Nm);
  add_legs(actuation.motor_tau_Nm());
  const double scalars[] = {truth.slide_m, truth.trunk_force_N, actuation.energy().electrical_J,
                            actuation.battery().charge, control_.model_mass_kg};
  hash_.Add(scalars, std::size(scalars));
}

}  // namespace scoria::test
