// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/runner.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "app/episode/odometer.h"
#include "app/episode/placement.h"
#include "core/hash.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "sim/sensors/sensors.h"

namespace scoria::app {
namespace {

constexpr int kHashEvery = 100;  // physics steps

std::uint64_t HashState(const RobotState& s, std::uint64_t before) {
  core::Hash64 hash;
  const double seed[] = {static_cast<double>(before >> 32),
                         static_cast<double>(before & 0xffffffffu)};
  hash.Add(seed, 2);
  hash.Add(s.p_WB.data(), 3);
  hash.Add(s.R_WB.data(), 9);
  hash.Add(s.v_WB.data(), 3);
  hash.Add(s.w_WB.data(), 3);
  hash.Add(Flatten(s.q).data(), kNumJoints);
  hash.Add(Flatten(s.qd).data(), kNumJoints);
  return hash.value();
}

bool IsFinite(const RobotState& s) {
  return s.p_WB.allFinite() && s.R_WB.allFinite() && s.v_WB.allFinite() && s.w_WB.allFinite();
}

/// One episode in progress.
class Episode {
 public:
  Episode(const Scenario& scenario, const core::RobotDescription& robot,
          const terrains::Heightfield& ground, const EpisodeSinks& sinks)
      : scenario_(scenario),
        robot_(robot),
        ground_(ground),
        sinks_(sinks),
        gravity_W_(0.0, 0.0, -scenario.gravity_mps2),
        world_(robot, ground, scenario.physics, gravity_W_, scenario.sliding_payload),
        payloads_(world_.truth().trunk, scenario.payloads),
        actuation_(robot),
        sensors_(robot, scenario.sensors, scenario.sensor_faults, gravity_W_,
                 scenario.physics.step_s, scenario.seed),
        operator_(scenario.operation, robot, ground),
        fault_rng_(scenario.seed, 0, core::Stream::kSolverFault),
        fall_monitor_(scenario.fall, robot.config.nominal_height_m, scenario.physics.step_s),
        wbc_every_(
            std::max(1, static_cast<int>(std::lround(
                            1.0 / (scenario.controller.rates.wbc_Hz * scenario.physics.step_s))))),
        give_truth_(NeedsTruthEver(scenario)),
        changes_(ChangedControllers(scenario)),
        pushes_(scenario.pushes.size()) {
    if (sinks.messages != nullptr) recorder_.emplace(*sinks.messages, scenario);
    result_.route = operator_.route();
    SetDown(operator_.start(), 0.0, scenario.start == StartPose::kStanding);
  }

  EpisodeResult Run() {
    const auto limit =
        static_cast<std::int64_t>(std::lround(scenario_.duration_s / scenario_.physics.step_s));
    result_.end = EpisodeEnd::kTimedOut;
    if (std::holds_alternative<VelocityProgramme>(scenario_.operation))
      result_.end = EpisodeEnd::kCompleted;
    for (step_ = 0; step_ < limit; ++step_) {
      if (sinks_.interrupted != nullptr && sinks_.interrupted->load()) {
        result_.end = EpisodeEnd::kInterrupted;
        break;
      }
      Step();
      if (const auto end = CheckEnd()) {
        result_.end = *end;
        break;
      }
    }
    result_.duration_s = time_s();
    const bool ordinary =
        result_.end == EpisodeEnd::kCompleted || result_.end == EpisodeEnd::kTimedOut;
    if (!ordinary) Announce("end", std::string(core::EnumName(result_.end)));
    result_.counters = counters_so_far();
    result_.unconverged_steps = world_.unconverged_steps();
    return result_;
  }

 private:
  [[nodiscard]] double time_s() const {
    return static_cast<double>(step_) * scenario_.physics.step_s;
  }

  /// Sensors, operator, controller, actuation, world.
  void Step() {
    core::Lap lap(result_.times);
    const double dt = scenario_.physics.step_s;
    const SensorFrame z =
        sensors_.Read(world_.truth(), actuation_.motor_tau_Nm(), step_, walking_s_, give_truth_);
    const Command command = Commanded();
    const controller::SolverFaults faults = DrawSolverFaults();
    lap.Book(core::Stage::kSensors);
    const controller::ControlOutput& control = controller_->Step(z, command, faults);
    lap = core::Lap(result_.times);
    result_.times += control.times;
    CountInjected(faults, control);
    AnnounceSensors(control.contact);
    AnnounceTransitions(control.transitions);
    Record(z, command, faults, control);
    if (sinks_.on_control) sinks_.on_control(*controller_, control);
    lap.Book(core::Stage::kRecord);
    world_.SetTrunkWrench(PushForce(), Vec3::Zero());
    ChangePayloads();
    ChangeController();
    const LegArray<Vec3> qd_before = world_.truth().state.qd;
    world_.Step(actuation_.Update(control.command, {z.q, z.qd}, qd_before, dt));
    actuation_.Meter(qd_before, world_.truth().state.qd, dt);
    if (control.operating) operating_s_ += dt;
    lap.Book(core::Stage::kPhysics);
    Watch(command);
    lap.Book(core::Stage::kRecord);
  }

  /// The operator's command; none while the robot lies, stands up or has just been placed.
  [[nodiscard]] Command Commanded() {
    const bool ready = operating_s_ >= scenario_.fall.stand_s && !fallen_;
    if (!ready) return {};
    walking_s_ += scenario_.physics.step_s;
    return operator_.Update(world_.truth().state, walking_s_, scenario_.physics.step_s);
  }

  /// Drawn at every step, so that a controller that runs slower meets the same faults.
  [[nodiscard]] controller::SolverFaults DrawSolverFaults() {
    controller::SolverFaults faults = DrawRandomFaults();
    for (const SolverOutage& outage : scenario_.solver_faults.outages) {
      const double since_s = walking_s_ - outage.at_s;
      if (since_s <= 0.0 || since_s > outage.duration_s) continue;
      (outage.solver == Solver::kMpc ? faults.mpc : faults.wbc) = outage.kind;
    }
    return faults;
  }

  [[nodiscard]] controller::SolverFaults DrawRandomFaults() {
    if (scenario_.solver_faults.share == 0.0) return {};
    using controller::SolverFault;
    constexpr std::array<SolverFault, 3> kKinds = {SolverFault::kFail, SolverFault::kNan,
                                                   SolverFault::kLate};
    const auto draw = [&] {
      const double u = fault_rng_.NextUniform() / scenario_.solver_faults.share;
      return u < 1.0 ? kKinds[static_cast<std::size_t>(3.0 * u)] : SolverFault::kNone;
    };
    controller::SolverFaults faults;
    faults.mpc = draw();
    faults.wbc = draw();
    return faults;
  }

  void CountInjected(const controller::SolverFaults& faults,
                     const controller::ControlOutput& control) {
    using controller::SolverFault;
    const auto add = [&](SolverFault fault, Count failure, Count late) {
      if (fault == SolverFault::kNone) return;
      result_.injected.Add(fault == SolverFault::kLate ? late : failure);
    };
    if (control.mpc_updated) add(faults.mpc, Count::kMpcFailure, Count::kMpcLate);
    if (control.wbc_updated) add(faults.wbc, Count::kWbcFailure, Count::kWbcLate);
  }

  /// Faults that begin, and whom the contact detection believes from now on.
  void AnnounceSensors(const ContactEstimate& contact) {
    for (std::size_t i = 0; i < sensors_.faults().size(); ++i) {
      if (sensors_.HasBegun(i))
        Announce("sensor_fault", std::string(core::EnumName(sensors_.faults()[i].kind)));
    }
    for (const Leg leg : kLegs) {
      const ContactSource now = contact.source[leg];
      if (control_in_charge() && now != contact_source_[leg])
        Announce("contact_source", fmt::format("{}: {}", LegName(leg), core::EnumName(now)));
      contact_source_[leg] = now;
    }
  }

  /// Stages that the controller gives up or takes back by itself.
  void AnnounceTransitions(const controller::Transitions& transitions) {
    for (std::size_t i = 0; i < transitions.count; ++i) {
      const controller::Transition& t = transitions.list[i];
      const std::string_view watch = core::EnumName(t.watch);
      Announce("supervisor",
               t.fell_back
                   ? fmt::format("{}: falls back on {} (quality {:.2f} below {:.2f}, {:.2f} s)",
                                 watch, controller::FallbackName(t.watch), t.quality,
                                 t.least_quality, t.lasted_s)
                   : fmt::format("{}: comes back (sound for {:.2f} s)", watch, t.lasted_s));
    }
  }

  /// A change stays: after a fall the controller starts with it.
  void ChangeController() {
    while (next_change_ < changes_.size() &&
           walking_s_ > scenario_.controller_changes[next_change_].at_s) {
      controller_->Reconfigure(changes_[next_change_]);
      Announce("controller_change",
               fmt::format("{}", fmt::join(scenario_.controller_changes[next_change_].set, ", ")));
      ++next_change_;
    }
  }

  void ChangePayloads() {
    for (const sim::TrunkChange& change : payloads_.Update(walking_s_, result_.walked_m))
      world_.SetTrunkParameters(change.trunk, change.attach_velocity);
    for (const std::string& text : payloads_.announcements()) Announce("payload", text);
  }

  /// A push starts once, when walking time first reaches it, and lasts its duration in simulated
  /// time.
  [[nodiscard]] Vec3 PushForce() {
    Vec3 f_W = Vec3::Zero();
    for (std::size_t i = 0; i < scenario_.pushes.size(); ++i) {
      const Push& push = scenario_.pushes[i];
      std::optional<ActivePush>& active = pushes_[i];
      if (!active && walking_s_ > push.at_s) {
        const double azimuth =
            core::RpyFromRotation(world_.truth().state.R_WB).z() + push.azimuth_rad;
        active = {time_s() + push.duration_s, push.impulse_Ns / push.duration_s *
                                                  Vec3(std::cos(azimuth), std::sin(azimuth), 0.0)};
        Announce("push", fmt::format("{} N s over {} s", push.impulse_Ns, push.duration_s));
      }
      if (active && time_s() < active->until_s) f_W += active->f_W;
    }
    return f_W;
  }

  void Record(const SensorFrame& z, const Command& command, const controller::SolverFaults& faults,
              const controller::ControlOutput& control) {
    if (step_ % wbc_every_ == 0 && (sinks_.on_row || recorder_)) {
      const sim::Truth& truth = world_.truth();
      const double ground_z = ground_.HeightAt(truth.state.p_WB.x(), truth.state.p_WB.y());
      const StepRecord record{step_,
                              time_s(),
                              truth,
                              z,
                              command,
                              control,
                              ControllerNow().gait,
                              counters_so_far(),
                              actuation_.energy(),
                              actuation_.battery(),
                              actuation_.motor_tau_Nm(),
                              ground_z,
                              fallen_,
                              segment_};
      const logs::LogRow row = MakeRow(record);
      const logs::SolveTimes times{control.mpc_updated ? control.mpc_solve_s : 0.0,
                                   control.wbc_updated ? control.wbc_solve_s : 0.0};
      if (sinks_.on_row) sinks_.on_row(row, times);
      if (recorder_) recorder_->Record(record, row);
    }
    if (recorder_) recorder_->RecordInput(time_s(), z, command, faults);
    if (step_ % kHashEvery == 0) {
      result_.state_hash = HashState(world_.truth().state, result_.state_hash);
      if (recorder_) recorder_->RecordHash(step_, time_s(), result_.state_hash);
    }
    constexpr int kProgressEvery = 250;
    if (sinks_.on_progress && step_ % kProgressEvery == 0) sinks_.on_progress(time_s());
  }

  /// Falls, getting stuck, distance, and what the operator does about them.
  void Watch(const Command& command) {
    const sim::Truth& truth = world_.truth();
    const Vec3& p_WB = truth.state.p_WB;
    if (fallen_) {
      lying_s_ += scenario_.physics.step_s;
      if (lying_s_ >= scenario_.fall.lie_s) PutOnFeet();
      return;
    }
    if (!control_in_charge()) {
      const FallCause cause = fall_monitor_.UpdateStandUp(truth, time_s() - stand_up_ends_s_);
      if (cause != FallCause::kNone) Fall(cause);
      return;
    }
    odometer_.Update(p_WB.head<2>(), scenario_.physics.step_s);
    result_.walked_m = odometer_.walked_m();
    const FallCause cause = fall_monitor_.Update(truth, ground_.HeightAt(p_WB.x(), p_WB.y()));
    if (cause != FallCause::kNone) {
      Fall(cause);
    } else if (fall_monitor_.UpdateStuck(p_WB, std::hypot(command.v_x_mps, command.v_y_mps))) {
      ++result_.stuck;
      Announce("stuck", fmt::format("at x {:.3f} m, y {:.3f} m", p_WB.x(), p_WB.y()));
      PutOnFeet();
    }
  }

  void Fall(FallCause cause) {
    const Vec3& p_WB = world_.truth().state.p_WB;
    const std::string_view name = core::EnumName(cause);
    fallen_ = true;
    CloseChord();
    lying_s_ = 0.0;
    ++result_.falls;
    result_.fall_events.push_back({time_s(), std::string(name), p_WB.head<2>()});
    Announce("fall", fmt::format("{} at x {:.3f} m, y {:.3f} m", name, p_WB.x(), p_WB.y()));
  }

  [[nodiscard]] bool control_in_charge() const { return operating_s_ > 0.0; }

  void CloseChord() {
    odometer_.CloseChord(world_.truth().state.p_WB.head<2>());
    result_.walked_m = odometer_.walked_m();
  }

  /// As in the field: the robot is set on its feet on the nearest good ground ahead. If it has not
  /// come away from its last place, the next 0.25 m are left out, and twice as much each time that
  /// this repeats.
  void PutOnFeet() {
    constexpr double kSamePlace_m = 1.0, kFurther_m = 0.25, kFurthest_m = 2.0;
    CloseChord();
    const RobotState& state = world_.truth().state;
    const Vec2 here_W = state.p_WB.head<2>();
    const bool same = last_place_W_ && (*last_place_W_ - here_W).norm() < kSamePlace_m;
    further_m_ = same ? std::clamp(2.0 * further_m_, kFurther_m, kFurthest_m) : 0.0;
    const Place place = SetDown({here_W, core::RpyFromRotation(state.R_WB).z()}, further_m_, true);
    last_place_W_ = place.p_WB;
    Announce("placed", fmt::format("at x {:.3f} m, y {:.3f} m", place.p_WB.x(), place.p_WB.y()));
  }

  /// Puts the robot down at rest near `wanted`, on its feet or folded, where it stands well, and
  /// starts a fresh controller. @returns where.
  Place SetDown(const Place& wanted, double ahead_m, bool standing) {
    constexpr double kEdge_m = 1.0;
    const double inside_m = std::max(0.0, ground_.half_size_m() - kEdge_m);
    std::vector<Place> places = operator_.PlacesAhead(wanted, ahead_m);
    for (Place& p : places) p.p_WB = p.p_WB.cwiseMax(-inside_m).cwiseMin(inside_m);
    const auto [place, margin] = ChoosePlace(robot_, ground_, places);
    if (margin <= 0.0)
      Announce("poor_ground", fmt::format("the robot hardly stands at x {:.3f} m, y {:.3f} m, the "
                                          "best place that the operator found",
                                          place.p_WB.x(), place.p_WB.y()));
    operator_.Resume(place);
    const RobotState state =
        standing ? PlaceStanding(robot_, ground_, place) : PlaceLying(robot_, ground_, place);
    world_.Reset(state);
    sensors_.Reset();
    actuation_.Reset();
    fall_monitor_.Reset();
    if (controller_) counters_ += controller_->counters();
    const std::int64_t next_step = controller_ ? step_ + 1 : 0;
    const controller::Start start{
        standing ? controller::Start::Pose::kStanding : controller::Start::Pose::kLying,
        {place.p_WB, ground_.HeightAt(place.p_WB.x(), place.p_WB.y()), place.yaw_rad},
        next_step,
        controller_ ? std::optional(controller_->model()) : std::nullopt};
    controller_ = std::make_unique<controller::Controller>(
        ControllerNow(), robot_, scenario_.gravity_mps2, scenario_.physics.step_s, start);
    if (recorder_) recorder_->RecordStart(time_s(), start);
    fallen_ = false;
    operating_s_ = 0.0;
    stand_up_ends_s_ = time_s() + controller::CalcStandUpTime(ControllerNow().stand_up, !standing);
    odometer_.Lift();
    ++segment_;
    return place;
  }

  [[nodiscard]] const controller::ControllerParams& ControllerNow() const {
    return next_change_ == 0 ? scenario_.controller : changes_[next_change_ - 1];
  }

  [[nodiscard]] Counters counters_so_far() const {
    Counters sum = counters_;
    return sum += controller_->counters();
  }

  void Announce(const std::string& kind, const std::string& detail) {
    if (sinks_.on_event) sinks_.on_event(time_s(), kind, detail);
    if (recorder_) recorder_->RecordEvent(step_, time_s(), kind, detail);
  }

  [[nodiscard]] std::optional<EpisodeEnd> CheckEnd() const {
    if (!IsFinite(world_.truth().state)) return EpisodeEnd::kNonFinite;
    if (result_.falls > 0 && result_.falls >= scenario_.max_falls) return EpisodeEnd::kFallLimit;
    const auto* route = std::get_if<RouteParams>(&scenario_.operation);
    if (route != nullptr && result_.walked_m >= route->distance_m) return EpisodeEnd::kCompleted;
    return std::nullopt;
  }

  const Scenario& scenario_;
  const core::RobotDescription& robot_;
  const terrains::Heightfield& ground_;
  const EpisodeSinks& sinks_;
  Vec3 gravity_W_;
  sim::World world_;
  sim::PayloadRack payloads_;
  sim::Actuation actuation_;
  sim::Sensors sensors_;
  Operator operator_;
  core::Rng fault_rng_;
  FallMonitor fall_monitor_;
  Odometer odometer_;
  int wbc_every_;
  bool give_truth_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<controller::Controller> controller_;
  Counters counters_;  // of controllers before the present one
  EpisodeResult result_;
  std::int64_t step_ = 0;
  std::uint32_t segment_ = 0;
  double operating_s_ = 0.0, walking_s_ = 0.0, lying_s_ = 0.0;
  double further_m_ = 0.0;  // than where it fell, the robot was put last
  double stand_up_ends_s_ = 0.0;
  bool fallen_ = false;
  struct ActivePush {
    double until_s;
    Vec3 f_W;
  };
  std::vector<controller::ControllerParams> changes_;
  std::size_t next_change_ = 0;
  LegArray<ContactSource> contact_source_;
  std::vector<std::optional<ActivePush>> pushes_;  // those that have started
  std::optional<Vec2> last_place_W_;
};

}  // namespace

EpisodeResult RunEpisode(const Scenario& scenario, const core::RobotDescription& robot,
                         const terrains::Heightfield& ground, const EpisodeSinks& sinks) {
  return std::make_unique<Episode>(scenario, robot, ground, sinks)->Run();
}

}  // namespace scoria::app
