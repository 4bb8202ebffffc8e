// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "controller/gait/gait_sequencer.h"
#include "controller/model/model_params.h"
#include "controller/mpc/mpc_runner.h"
#include "controller/reference/reference_planner.h"
#include "controller/safety/leg_state_machine.h"
#include "controller/safety/output_guard.h"
#include "controller/safety/stage_quality.h"
#include "controller/safety/supervisor.h"
#include "controller/sensing.h"
#include "controller/stand_up.h"
#include "controller/swing/foothold_planner.h"
#include "controller/swing/swing_trajectory.h"
#include "controller/wbc/whole_body_controller.h"
#include "core/clock.h"
#include "core/clone_ptr.h"
#include "core/robot/counters.h"
#include "core/robot/whole_body.h"
#include "core/stage_times.h"

namespace scoria::controller {

struct RateParams {
  double wbc_Hz = 500.0, mpc_Hz = 100.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("wbc_Hz", wbc_Hz, {.min = 50.0, .max = 1000.0, .doc = "whole-body control and swing"});
    a.Field("mpc_Hz", mpc_Hz, {.min = 10.0, .max = 500.0, .doc = "gait, reference and MPC"});
  }
  bool operator==(const RateParams&) const = default;
};

struct ControllerParams {
  RateParams rates;
  ModelParams model;
  SampleGuardParams samples;
  ContactParams contact;
  EstimatorParams estimator;
  AdapterParams adaptation;
  GaitParams gait = AgsParams{};
  ReferenceParams reference;
  FootholdParams foothold;
  LegStateParams legs;
  SwingParams swing;
  MpcParams mpc;
  WbcParams wbc = TsidParams{};
  SafetyParams safety;
  QualityParams quality;
  SupervisorParams supervisor;
  StandUpParams stand_up;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rates", rates);
    a.Field("model", model);
    a.Field("samples", samples);
    a.Field("contact", contact);
    a.Field("estimator", estimator);
    a.Field("adaptation", adaptation);
    a.Field("gait", gait);
    a.Field("reference", reference);
    a.Field("foothold", foothold);
    a.Field("legs", legs);
    a.Field("swing", swing);
    a.Field("mpc", mpc);
    a.Field("wbc", wbc);
    a.Field("safety", safety);
    a.Field("quality", quality);
    a.Field("supervisor", supervisor);
    a.Field("stand_up", stand_up);
  }
  bool operator==(const ControllerParams&) const = default;
};

/// Everything that one tick decided, for the record. `*_updated` tells which parts are new.
struct ControlOutput : Sensed {
  JointCommand command;
  double model_mass_kg = 0.0;  // that gait, MPC and body control act on
  bool operating = false;      // false while standing up
  bool wbc_updated = false, mpc_updated = false;
  ContactPlan contacts;
  LegPhases legs;
  FootTargets feet;
  LegArray<Vec3> f_F_W = ZeroPerLeg();  // forces that the body controller expects
  BodyReference::Stage target;          // body target of the body controller
  BodyReference::Stage reference;       // what the operator's command asks for now
  double ground_z_m = 0.0;
  SolveStatus mpc_status = SolveStatus::kOptimal, wbc_status = SolveStatus::kOptimal;
  int mpc_iterations = 0, wbc_iterations = 0;
  double mpc_solve_s = 0.0, wbc_solve_s = 0.0;  // wall clock
  Qualities qualities{};                        // of the stages, by their own word
  Transitions transitions;                      // of this step
  std::array<bool, kNumMonitors> fallen_back{};
  core::StageTimes times;  // of this step
};

/// A fault to be played on a solver's next answer: it fails, claims success with NaN, or is late.
enum class SolverFault { kNone, kFail, kNan, kLate };
constexpr std::array<std::pair<SolverFault, std::string_view>, 3> EnumNames(SolverFault) {
  return {{{SolverFault::kFail, "fail"}, {SolverFault::kNan, "nan"}, {SolverFault::kLate, "late"}}};
}
struct SolverFaults {
  SolverFault mpc = SolverFault::kNone, wbc = SolverFault::kNone;
};

/// The parts of the parameters that sensing takes.
[[nodiscard]] SensingParams SensingOf(const ControllerParams& params);

/// @returns true if a stage needs SensorFrame::truth.
[[nodiscard]] bool NeedsTruth(const ControllerParams& params) noexcept;

/// How a robot starts.
struct Start {
  enum class Pose { kLying, kStanding };
  Pose pose = Pose::kStanding;
  Placement placement;
  std::int64_t step = 0;  // index of the physics step; ticks fall on multiples of the global step
  std::optional<core::ModelParameters> model;  // known from before; else the nominal one
};

/// The hierarchy: estimation every physics step, gait, reference, footholds and MPC at mpc_Hz,
/// legs, swing and whole-body control at wbc_Hz. Allocates only when it is built, copied or
/// reconfigured; Step neither throws, prints nor locks.
///
/// A copy goes on where the original is, with the same bits from the same inputs, and neither
/// touches the other; both borrow the same robot. It waits for an MPC solve that is under way on a
/// thread.
class Controller {
 public:
  /// @param robot borrowed. @param step_s physics step; rates must be whole multiples of it.
  Controller(const ControllerParams& params, const core::RobotDescription& robot,
             double gravity_mps2, double step_s, const Start& start = {});

  /// @param faults       played on the solvers if this is one of their ticks.
  /// @param true_inputs  for studies only.
  [[nodiscard]] const ControlOutput& Step(const SensorFrame& z, const Command& command,
                                          const SolverFaults& faults = {},
                                          const TrueInputs& true_inputs = {}) noexcept;

  /// Changes variants and parameters while walking, between two steps: phases, targets, estimates
  /// and the plan in force are kept; stages that do not change are not touched. Rates stay as they
  /// are. Allocates.
  void Reconfigure(const ControllerParams& params);

  /// What the last Step decided.
  [[nodiscard]] const ControlOutput& output() const noexcept { return out_; }
  /// Everything that did not go to plan, since the start.
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }
  /// What gait, MPC and body control act on.
  [[nodiscard]] const core::ModelParameters& model() const noexcept {
    return sensing_.model().parameters();
  }
  [[nodiscard]] const ConvexMpc& mpc() const noexcept { return mpc_->mpc(); }
  [[nodiscard]] const WholeBodyController& wbc() const noexcept { return *wbc_; }

 private:
  void Sense(const SensorFrame& z, const TrueInputs& true_inputs) noexcept;
  void StepPlans(const Command& command, const LocalGround* ground) noexcept;
  void TakePlan(SolverFault fault) noexcept;
  void StepBody(SolverFault fault) noexcept;
  [[nodiscard]] WbcResult SolveBody(const WbcInput& in, SolverFault fault) noexcept;
  void Supervise() noexcept;
  [[nodiscard]] double CalcTorqueShortfall(const ForcePlan& plan) const noexcept;
  [[nodiscard]] StageReports Report() const noexcept;
  void Act(const Transition& transition) noexcept;
  [[nodiscard]] ContactChoice ContactChoiceInForce() const noexcept;

  ControllerParams params_;
  const core::RobotDescription& robot_;
  core::StepClock clock_;
  std::int64_t first_step_;
  int mpc_every_, wbc_every_;
  double torque_shortfall_ = 0.0;
  bool operating_;
  double foot_radius_m_;
  Sensing sensing_;
  StandUp stand_up_;
  core::ClonePtr<GaitSequencer> gait_;
  ReferencePlanner reference_planner_;
  FootholdPlanner foothold_planner_;
  LegStateMachine leg_states_;
  SwingTrajectory swing_;
  core::ClonePtr<MpcRunner> mpc_;
  core::ClonePtr<WholeBodyController> wbc_, fallback_;
  OutputGuard guard_;
  StageQuality quality_;
  Supervisor supervisor_;

  BodyReference reference_;
  FootholdPlan footholds_;
  struct DatedPlan {
    ForcePlan plan;
    std::int64_t step = 0;  // when its state was taken
  };
  DatedPlan active_, late_;  // in force; came too late for the last tick
  std::int64_t mpc_since_ = 0, contacts_step_ = 0, command_step_ = 0;
  bool body_answered_ = true;
  Counters counters_;
  ControlOutput out_;
};

}  // namespace scoria::controller
