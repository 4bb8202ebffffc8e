// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/riccati_ipm.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Weights of the squared tracking errors of one state block.
struct MpcWeights {
  Vec3 rpy = Vec3(200.0, 200.0, 50.0);
  Vec3 position = Vec3(5.0, 5.0, 100.0);
  Vec3 angular_velocity = Vec3(0.2, 0.2, 0.8);
  Vec3 velocity = Vec3(20.0, 20.0, 0.3);
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kMax = 1e8;
    a.Field("rpy", rpy, {.min = 0.0, .max = kMax, .doc = "per rad^2"});
    a.Field("position", position,
            {.min = 0.0,
             .max = kMax,
             .doc = "per m^2",
             .scale = core::Pow(core::dimension::kLength, -2.0)});
    a.Field("angular_velocity", angular_velocity,
            {.min = 1e-6,
             .max = kMax,
             .doc = "per (rad/s)^2",
             .scale = core::Pow(core::dimension::kTime, 2.0)});
    a.Field("velocity", velocity,
            {.min = 1e-6,
             .max = kMax,
             .doc = "per (m/s)^2",
             .scale = core::Pow(core::dimension::kSpeed, -2.0)});
  }
  bool operator==(const MpcWeights&) const = default;
};

struct MpcParams {
  int horizon = 20;
  double stage_s = 0.05;
  double force_weight = 1e-5;
  double friction = 0.45;
  double f_min_N = 5.0, f_max_N = 250.0;
  MpcWeights move;
  MpcWeights stand{Vec3::Constant(200.0), Vec3(200.0, 200.0, 200.0), Vec3::Constant(1.0),
                   Vec3::Constant(20.0)};
  int latency_ticks = 1;
  bool threaded = false;
  RiccatiIpmParams solver;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("horizon", horizon, {.min = 2, .max = kMaxHorizon, .doc = "stages"});
    a.Field("stage_s", stage_s, {.min = 0.005, .max = 0.2, .scale = core::dimension::kTime});
    a.Field("force_weight", force_weight,
            {.min = 1e-9,
             .max = 1.0,
             .doc = "per N^2",
             .scale = core::Pow(core::dimension::kForce, -2.0)});
    a.Field("friction", friction, {.min = 0.05, .max = 2.0, .doc = "assumed, of the pyramid"});
    a.Field("f_min_N", f_min_N,
            {.min = 0.0,
             .max = 1e3,
             .doc = "normal force of a stance foot",
             .scale = core::dimension::kForce});
    a.Field("f_max_N", f_max_N, {.min = 1.0, .max = 1e4, .scale = core::dimension::kForce});
    a.Field("move", move);
    a.Field("stand", stand);
    a.Field("latency_ticks", latency_ticks,
            {.min = 0,
             .max = 5,
             .doc = "a result is used this many MPC ticks after its state was taken"});
    a.Field("threaded", threaded,
            {.doc = "solve on a thread of its own; the same bits, spread over two cores"});
    a.Field("solver", solver);
  }
  [[nodiscard]] std::string Problem() const {
    return f_min_N < f_max_N ? "" : "f_min_N must be below f_max_N";
  }
  bool operator==(const MpcParams&) const = default;
};

/// A snapshot: it may be solved on another thread.
struct MpcInput {
  core::WholeBody wb;
  ContactPlan contacts;
  LegPhases legs;  // who stands now
  BodyReference reference;
  FootholdPlan footholds;

  /// Who bears force at a stage: at first who stands now, then the plan; a foot that touched early
  /// stands on.
  [[nodiscard]] bool StandsAt(Leg leg, int stage) const noexcept;
};

struct MpcResult {
  ForcePlan plan;
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
};

/// Convex model-predictive control of the single rigid body: twelve states (roll pitch yaw, COM
/// position, angular velocity, COM velocity, all in W), forward Euler, one force per stance foot in
/// the frame of the ground plane. Source: [DiCarlo2018]; differs: state about the COM, inertia from
/// the whole-body model turned with the reference heading, contact points under the sphere centres,
/// pyramids along the ground's normal.
class ConvexMpc {
 public:
  ConvexMpc(const MpcParams& params, const core::RobotDescription& robot, double gravity_mps2);

  [[nodiscard]] MpcResult Solve(const MpcInput& in) noexcept;

  /// The last problem and its solution, for saving and for tests.
  [[nodiscard]] const OcpQp& qp() const noexcept { return qp_; }
  [[nodiscard]] const OcpSolution& solution() const noexcept { return solver_.solution(); }

 private:
  void Build(const MpcInput& in) noexcept;
  [[nodiscard]] ForcePlan ToPlan() const noexcept;

  MpcParams params_;
  double foot_radius_m_;
  double gravity_mps2_;
  RiccatiIpm solver_;
  OcpQp qp_;
  Mat3 R_WT_ = Mat3::Identity();  // ground frame T: z along the normal, x along the heading
};

}  // namespace scoria::controller
