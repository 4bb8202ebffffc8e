// SPDX-License-Identifier: BSD-3-Clause
#include "sim/plant/plant.h"

#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/clone_ptr.h"
#include "core/demand.h"
#include "core/robot/kinematics.h"
#include "sim/contact/contact_finder.h"
#include "sim/engines/bullet/bullet_engine.h"
#include "sim/engines/scoria/scoria_engine.h"
#include "sim/plant/work.h"

namespace scoria::sim {

using core::RobotDescription;

namespace {

std::unique_ptr<Engine> MakeEngine(const RobotDescription& robot, const PhysicsParams& params,
                                   const Vec3& gravity_W) {
  const SolverParams solver{params.max_solver_iterations, params.solver_residual};
  struct Make {
    const RobotDescription& robot;
    const SolverParams& solver;
    const Vec3& gravity_W;
    std::unique_ptr<Engine> operator()(const ScoriaDynamics&) const {
      return std::make_unique<ScoriaEngine>(robot, solver);
    }
    std::unique_ptr<Engine> operator()(const BulletDynamics&) const {
      return std::make_unique<BulletEngine>(robot, gravity_W, solver);
    }
  };
  return std::visit(Make{robot, solver, gravity_W}, params.engine);
}

}  // namespace

std::string EngineName(const EngineParams& engine) {
  return std::visit([](const auto& type) { return std::string(type.kType); }, engine);
}

std::string EngineProblem(const PhysicsParams& params, bool has_sliding_payload) {
  if (!std::holds_alternative<BulletDynamics>(params.engine)) return "";
  constexpr const char* kOther = "engine bullet cannot express it; physics.engine.type: scoria can";
  if (std::holds_alternative<PlasticGround>(params.ground))
    return fmt::format("physics.ground.type: plastic: {}", kOther);
  if (has_sliding_payload) return fmt::format("sliding_payload: {}", kOther);
  return "";
}

struct Plant::Impl {
  Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
       const PhysicsParams& params_in, const Vec3& gravity_in_W,
       const std::optional<SlidingPayloadParams>& sliding_in);

  void FindContacts();
  void RecordContacts();
  void Move(const RobotState& after);
  void UpdateTruth();
  void Impact(const Mat18& H_before);

  const RobotDescription& robot;
  const terrains::Heightfield& ground;
  PhysicsParams params;
  Vec3 gravity_W;
  core::WholeBodyModel model;
  core::WholeBody whole_body;  // at truth.state, without a sliding payload
  std::optional<SlidingPayload> sliding;
  core::ClonePtr<Engine> engine;
  ContactFinder contact_finder;
  // What a foot of the bare robot typically carries: the ground's damping ratio refers to it, and
  // the ground does not change with the payload.
  double load_kg;
  LegArray<FootGround> feet;
  LegArray<Vec3> foot_impulse_W = ZeroPerLeg();  // of the last step: where the solver starts
  std::vector<ContactPoint> contacts;
  int iterations = 0;  // of the last step
  std::int64_t unconverged_steps = 0;
  Truth truth;
  Vec3 impact_v_WB = Vec3::Zero();  // change of v_WB since the last step, by payloads
  double friction_scale = 1.0;
  Vec3 f_trunk_W = Vec3::Zero(), t_trunk_W = Vec3::Zero();
};

Plant::Impl::Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
                  const PhysicsParams& params_in, const Vec3& gravity_in_W,
                  const std::optional<SlidingPayloadParams>& sliding_in)
    : robot(robot_in),
      ground(ground_in),
      params(params_in),
      gravity_W(gravity_in_W),
      model(robot_in, gravity_in_W),
      engine(MakeEngine(robot_in, params_in, gravity_in_W)),
      contact_finder(robot_in, ground_in),
      load_kg(robot_in.total_mass_kg() / kNumLegs) {
  const std::string problem = EngineProblem(params, sliding_in.has_value());
  SCORIA_DEMAND(problem.empty(), "{}", problem);
  if (sliding_in) sliding.emplace(*sliding_in, gravity_in_W);
}

void Plant::Impl::FindContacts() {
  const RobotState& state = truth.state;
  contact_finder.Find(core::CalcLinkPoses(robot, state.p_WB, state.R_WB, state.q), state.p_WB,
                      contacts);
  LegArray<bool> near(false);
  for (ContactPoint& c : contacts) {
    const Vec3 p_WP = state.p_WB + c.p_BP_W;
    terrains::GroundSample sample = ground.GroundAt(p_WP.x(), p_WP.y());
    sample.friction *= friction_scale;
    if (!c.is_foot) {
      PrepareBodyContact(sample, load_kg, c);
      continue;
    }
    const Leg leg = core::LegOf(c.body);
    // The sphere's velocity along the normal is the same all over it.
    feet[leg].Prepare(sample, p_WP, -c.n_W.dot(whole_body.v_WF[leg]), params.step_s, c);
    c.impulse_W = foot_impulse_W[leg];
    near[leg] = true;
  }
  for (const Leg leg : kLegs) {
    if (!near[leg]) feet[leg].Lift();
  }
}

/// Forces of the step, and what the feet did to the ground.
void Plant::Impl::RecordContacts() {
  truth.f_F_W = foot_impulse_W = ZeroPerLeg();
  truth.f_normal_N = truth.penetration_m = LegArray<double>(0.0);
  truth.contact = LegArray<bool>(false);
  const double contact_force_N = 5.0 * robot.similarity.Factor(core::dimension::kForce);
  Vec3 ground_on_trunk_W = Vec3::Zero();
  for (const ContactPoint& c : contacts) {
    const Vec3 f_W = c.impulse_W / params.step_s;
    if (c.body == 0) ground_on_trunk_W += f_W;
    if (!c.is_foot) continue;
    const Leg leg = core::LegOf(c.body);
    foot_impulse_W[leg] = c.impulse_W;
    truth.f_F_W[leg] = f_W;
    truth.f_normal_N[leg] = c.n_W.dot(f_W);
    truth.contact[leg] = truth.f_normal_N[leg] > contact_force_N;
    truth.penetration_m[leg] = -c.gap_m;
    feet[leg].Finish(c, truth.state.p_WB + c.p_BP_W, params.step_s);
  }
  truth.trunk_force_N = ground_on_trunk_W.norm();
}

/// Takes over what the engine found.
void Plant::Impl::Move(const RobotState& after) {
  RobotState& state = truth.state;
  const double dt = params.step_s;
  if (sliding) {
    Vec6 change;
    change << after.v_WB - state.v_WB, after.w_WB - state.w_WB;
    truth.energy.work.joint_J += sliding->Step(state, change, dt);
  }
  truth.a_WB = (after.v_WB - state.v_WB + impact_v_WB) / dt;
  impact_v_WB.setZero();
  state = after;
}

void Plant::Impl::UpdateTruth() {
  model.Calc(truth.state, whole_body);
  truth.p_WC = whole_body.p_WC;
  truth.mass_kg = whole_body.mass_kg;
  truth.p_WF = whole_body.p_WF;
  truth.energy.kinetic_J = CalcKineticEnergy(whole_body);
  // Semi-implicit Euler is a leapfrog: its velocity belongs to half a step ago.
  const Vec3 p_WC_then = whole_body.p_WC - 0.5 * params.step_s * whole_body.v_WC;
  truth.energy.potential_J = -whole_body.mass_kg * gravity_W.dot(p_WC_then);
  truth.trunk = model.parameters().trunk;
  if (!sliding) return;
  const double m = sliding->mass_kg();
  truth.mass_kg += m;
  truth.p_WC += m / truth.mass_kg * (sliding->CalcPosition(truth.state) - truth.p_WC);
  truth.slide_m = sliding->x_m();
  truth.slide_mps = sliding->rate_mps();
  truth.energy.kinetic_J += sliding->CalcKineticEnergy(truth.state);
  truth.energy.potential_J += sliding->CalcPotentialEnergy(truth.state, params.step_s);
}

/// Plastic impact with what was added to the trunk at rest, at a mass matrix that is the new one
/// already. The trunk drags a sliding payload only across its line.
void Plant::Impl::Impact(const Mat18& H_before) {
  RobotState& state = truth.state;
  Vec18 v;
  v.head<6>() << state.v_WB, state.w_WB;
  for (const Leg leg : kLegs) {
    v.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg)) = state.qd[leg];
  }
  Mat18 H = AssembleMassMatrix(whole_body);
  const Vec18 lacking = (H_before - H) * v;
  if (sliding) H.topLeftCorner<6, 6>() += sliding->CalcImpactInertia(state);
  const Vec18 change = H.llt().solve(lacking);
  if (sliding) sliding->Kick(state, change.head<6>());
  impact_v_WB += change.head<3>();
  state.v_WB += change.head<3>();
  state.w_WB += change.segment<3>(3);
  for (const Leg leg : kLegs) {
    state.qd[leg] += change.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg));
  }
}

Plant::Plant(const RobotDescription& robot, const terrains::Heightfield& ground,
             const PhysicsParams& params, const Vec3& gravity_W,
             const std::optional<SlidingPayloadParams>& sliding)
    : impl_(std::make_unique<Impl>(robot, ground, params, gravity_W, sliding)) {
  Reset(RobotState{});
}

Plant::~Plant() = default;

Plant::Plant(const Plant& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}

void Plant::Reset(const RobotState& state) {
  Impl& w = *impl_;
  w.contact_finder.Forget();
  w.foot_impulse_W = ZeroPerLeg();
  w.engine->Reset();
  w.impact_v_WB.setZero();
  if (w.sliding) w.sliding->Reset();
  for (const Leg leg : kLegs) {
    w.feet[leg] = FootGround(w.params.ground, w.robot.legs[leg].foot_radius_m, w.load_kg);
  }
  w.truth = Truth{};
  w.truth.state = state;
  w.UpdateTruth();
  w.truth.energy.initial_J = w.truth.energy.kinetic_J + w.truth.energy.potential_J;
}

void Plant::Step(const LegArray<Vec3>& tau_Nm) {
  Impl& w = *impl_;
  w.FindContacts();
  const Vec3 p_BC_W = w.truth.state.R_WB * w.robot.trunk.p_OC;
  Vec6 wrench_B_W;
  wrench_B_W << w.f_trunk_W, w.t_trunk_W + p_BC_W.cross(w.f_trunk_W);
  const double dt = w.params.step_s;
  if (w.sliding) w.sliding->AddTo(w.whole_body, dt);
  const StepInput input{w.whole_body, w.model.parameters().trunk, tau_Nm, wrench_B_W, dt};
  const StepResult result = w.engine->Step(input, w.contacts);
  w.truth.energy.work += CalcWork(input, result, w.contacts);
  w.RecordContacts();
  w.Move(result.state);
  w.UpdateTruth();
  w.iterations = result.iterations;
  if (w.iterations >= w.params.max_solver_iterations) ++w.unconverged_steps;
}

const Truth& Plant::truth() const noexcept { return impl_->truth; }

int Plant::solver_iterations() const noexcept { return impl_->iterations; }

std::int64_t Plant::unconverged_steps() const noexcept { return impl_->unconverged_steps; }

void Plant::SetTrunkWrench(const Vec3& f_W, const Vec3& t_W) {
  impl_->f_trunk_W = f_W;
  impl_->t_trunk_W = t_W;
}

void Plant::SetFrictionScale(double scale) {
  SCORIA_DEMAND(scale >= 0.0, "friction scale {}", scale);
  impl_->friction_scale = scale;
}

void Plant::RemoveSlidingPayload() {
  Impl& w = *impl_;
  if (!w.sliding) return;
  EnergyLedger& e = w.truth.energy;
  const double before_J = e.kinetic_J + e.potential_J;
  w.sliding.reset();
  w.truth.slide_m = w.truth.slide_mps = 0.0;
  w.UpdateTruth();
  e.work.external_J += e.kinetic_J + e.potential_J - before_J;
}

void Plant::SetTrunkParameters(const core::SpatialInertia& trunk, AttachVelocity attach_velocity) {
  Impl& w = *impl_;
  EnergyLedger& e = w.truth.energy;
  const double before_J = e.kinetic_J + e.potential_J;
  const Mat18 H_before = AssembleMassMatrix(w.whole_body);
  w.model.SetParameters({trunk});
  if (attach_velocity == AttachVelocity::kRest) {
    w.model.Calc(w.truth.state, w.whole_body);
    w.Impact(H_before);
  }
  w.UpdateTruth();
  e.work.external_J += e.kinetic_J + e.potential_J - before_J;
}

}  // namespace scoria::sim
