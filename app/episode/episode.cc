// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/episode.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/episode/event_texts.h"
#include "app/episode/placement.h"
#include "app/episode/rows.h"
#include "app/episode/state_hash.h"
#include "core/math/so3.h"
#include "core/rate.h"
#include "sim/true_ground.h"

namespace scoria::app {
namespace {

bool IsFinite(const RobotState& s) {
  return s.p_WB.allFinite() && s.R_WB.allFinite() && s.v_WB.allFinite() && s.w_WB.allFinite();
}

/// @param ground_z_m  under the trunk, where it matters.
analysis::FallSample ToFallSample(const sim::Truth& truth, double dt_s,
                                  std::optional<double> ground_z_m = std::nullopt) {
  analysis::FallSample sample{.dt_s = dt_s};
  sample.tilt_rad = std::acos(std::clamp(truth.state.R_WB(2, 2), -1.0, 1.0));
  if (ground_z_m) sample.height_m = truth.state.p_WB.z() - *ground_z_m;
  sample.trunk_force_N = truth.trunk_force_N;
  return sample;
}

Vec3 GravityOf(const Scenario& scenario) { return {0.0, 0.0, -scenario.gravity_mps2}; }

/// A trunk must keep some mass.
void CheckModel(const controller::ControllerParams& params, const core::RobotDescription& robot) {
  constexpr double kLeastShare = 0.1;
  const double trunk_kg = robot.trunk.mass_kg;
  if (trunk_kg + params.model.mass_offset_kg >= kLeastShare * trunk_kg) return;
  throw core::ConfigError({}, "controller.model.mass_offset_kg",
                          fmt::format("{}: leaves the trunk of {:.2f} kg less than a tenth",
                                      params.model.mass_offset_kg, trunk_kg));
}

}  // namespace

Episode::Episode(const Scenario& scenario, const core::RobotDescription& robot,
                 const terrains::Heightfield& ground)
    : scenario_(scenario),
      robot_(robot),
      ground_(ground),
      plant_(robot, ground, scenario.physics, GravityOf(scenario), scenario.sliding_payload),
      payloads_(plant_.truth().trunk, scenario.payloads),
      actuation_(robot),
      sensors_(robot, scenario.sensors, scenario.sensor_faults, GravityOf(scenario),
               scenario.physics.step_s, scenario.seed),
      operator_(scenario.operation, robot, ground),
      solver_faults_(scenario.solver_faults, scenario.seed),
      pushes_(scenario.pushes),
      changes_(scenario),
      fall_detector_(scenario.fall, robot.config.nominal_height_m),
      stuck_detector_(scenario.fall),
      limit_(std::lround(scenario.duration_s / scenario.physics.step_s)),
      row_every_(core::RateDivider(scenario.controller.rates.wbc_Hz, scenario.physics.step_s)
                     .every_steps()),
      give_truth_(NeedsTruthEver(scenario)) {
  CheckModel(scenario.controller, robot);
  for (const auto& changed : ChangedControllers(scenario)) CheckModel(changed, robot);
  result_.route = operator_.route();
  SetDown(operator_.start(), 0.0, scenario.start == StartPose::kStanding);
}

void Episode::Attach(EpisodeObserver& observer) {
  for (const EpisodeEvent& event : events_) observer.OnEvent(event);
  observer.OnStart(time_s(), *start_);
  observers_.push_back(&observer);
}

std::unique_ptr<Episode> Episode::Clone() const {
  std::unique_ptr<Episode> clone(new Episode(*this));
  clone->observers_.clear();
  return clone;
}

void Episode::Intervene(const Intervention& intervention) {
  std::visit([this](const auto& change) { Apply(change); }, intervention);
  Announce("intervention", Describe(intervention));
}

void Episode::Apply(const PayloadOff&) {
  if (const auto change = payloads_.RemoveAll())
    plant_.SetTrunkParameters(change->trunk, change->attach_velocity);
  plant_.RemoveSlidingPayload();
}

void Episode::Apply(const controller::ControllerParams& params) {
  changes_.Override(params);
  controller_->Reconfigure(params);
}

/// What studies give the controller in place of its own findings; the ground is given in Step.
controller::TrueInputs Episode::TrueInputsNow() const {
  controller::TrueInputs inputs;
  const sim::Truth& truth = plant_.truth();
  if (truth_for_.state) inputs.state = truth.state;
  if (truth_for_.model) inputs.trunk = core::ModelParameters{truth.trunk};
  if (!truth_for_.contact) return inputs;
  inputs.contact = truth.contact;
  return inputs;
}

/// Sensors, operator, controller, actuation, plant.
void Episode::Step() {
  core::Lap lap(result_.times);
  const double dt = scenario_.physics.step_s;
  sensed_ = sensors_.Read(plant_.truth(), actuation_.motor_tau_Nm(), step_, clock(), give_truth_);
  command_ = NextCommand();
  faults_ = solver_faults_.Draw(clock());
  lap.Book(core::Stage::kSensors);
  retired_.reset();
  const sim::TrueGround true_ground(ground_, plant_.truth().state);
  controller::TrueInputs true_inputs = TrueInputsNow();
  if (truth_for_.ground) true_inputs.ground = &true_ground;
  const controller::ControlOutput& control =
      controller_->Step(sensed_, command_, faults_, true_inputs);
  lap = core::Lap(result_.times);
  result_.times += control.times;
  solver_faults_.CountInjected(faults_, control);
  AnnounceSensors();
  UpdateHash();
  Show();
  lap.Book(core::Stage::kRecord);
  MakeChanges();
  const LegArray<Vec3> qd_before = plant_.truth().state.qd;
  plant_.Step(actuation_.Update(control.command, {sensed_.q, sensed_.qd}, qd_before, dt));
  actuation_.Meter(qd_before, plant_.truth().state.qd, dt);
  if (control.operating) operating_s_ += dt;
  lap.Book(core::Stage::kPhysics);
  CheckRobot();
  lap.Book(core::Stage::kRecord);
  if (const auto end = FindEnd()) {
    End(*end);
  } else if (++step_ >= limit_) {
    End(EndByTime());
  }
}

/// The operator's command; none while the robot lies, stands up or has just been placed.
Command Episode::NextCommand() {
  const bool ready = operating_s_ >= scenario_.fall.stand_s && !fallen_;
  if (!ready) return {};
  walking_s_ += scenario_.physics.step_s;
  return operator_.Update(plant_.truth().state, walking_s_, scenario_.physics.step_s);
}

/// What the scenario's timed events change before the physics moves on.
void Episode::MakeChanges() {
  const double yaw_rad = core::RpyFromRotation(plant_.truth().state.R_WB).z();
  const core::EventClock now = clock();
  for (const Push& push : pushes_.Update(now, yaw_rad)) Announce("push", DescribePush(push));
  plant_.SetTrunkWrench(pushes_.ForceAt(now), Vec3::Zero());
  for (const sim::TrunkChange& change : payloads_.Update(now))
    plant_.SetTrunkParameters(change.trunk, change.attach_velocity);
  for (const std::string& text : payloads_.announcements()) Announce("payload", text);
  while (const ControllerChange* change = changes_.Next(now)) {
    controller_->Reconfigure(changes_.in_force());
    Announce("controller_change", DescribeChange(*change));
  }
}

void Episode::UpdateHash() {
  hashed_ = step_ % kHashEvery == 0;
  if (hashed_) result_.state_hash = ChainHash(plant_.truth().state, result_.state_hash);
}

void Episode::Show() {
  if (observers_.empty()) return;
  const StepRecord record = Record();
  const bool wanted =
      step_ % row_every_ == 0 && std::ranges::any_of(observers_, &EpisodeObserver::wants_rows);
  std::optional<logs::Row> row;
  if (wanted) row = MakeRow(record);
  for (EpisodeObserver* observer : observers_) {
    if (row && observer->wants_rows()) observer->OnRow(record, *row);
    observer->OnStep(record);
  }
}

/// Faults that begin, contact sources and stages that the controller changes by itself.
void Episode::AnnounceSensors() {
  for (std::size_t i = 0; i < sensors_.faults().size(); ++i) {
    if (sensors_.HasBegun(i))
      Announce("sensor_fault", std::string(core::EnumName(sensors_.faults()[i].kind)));
  }
  const controller::ControlOutput& decided = control();
  for (const Leg leg : kLegs) {
    const ContactSource now = decided.contact.source[leg];
    if (control_in_charge() && now != contact_source_[leg])
      Announce("contact_source", DescribeSource(leg, now));
    contact_source_[leg] = now;
  }
  for (std::size_t i = 0; i < decided.transitions.count; ++i)
    Announce("supervisor", DescribeTransition(decided.transitions.list[i]));
}

/// Falls, getting stuck, distance, and what the operator does about them.
void Episode::CheckRobot() {
  const sim::Truth& truth = plant_.truth();
  const Vec3& p_WB = truth.state.p_WB;
  const double dt_s = scenario_.physics.step_s;
  if (fallen_) {
    lying_s_ += dt_s;
    if (lying_s_ >= scenario_.fall.lie_s) PutOnFeet();
    return;
  }
  if (!control_in_charge()) {
    const analysis::FallCause cause =
        fall_detector_.UpdateStandUp(ToFallSample(truth, dt_s), time_s() - stand_up_ends_s_);
    if (cause != analysis::FallCause::kNone) Fall(cause);
    return;
  }
  path_.Add({dt_s, p_WB.head<2>()});
  result_.walked_m = path_.length_m();
  const analysis::FallCause cause =
      fall_detector_.Update(ToFallSample(truth, dt_s, ground_.HeightAt(p_WB.x(), p_WB.y())));
  if (cause != analysis::FallCause::kNone) {
    Fall(cause);
  } else if (stuck_detector_.Update(
                 {dt_s, p_WB.head<2>(), std::hypot(command_.v_x_mps, command_.v_y_mps)})) {
    ++result_.stuck;
    Announce("stuck", fmt::format("at x {:.3f} m, y {:.3f} m", p_WB.x(), p_WB.y()));
    PutOnFeet();
  }
}

void Episode::Fall(analysis::FallCause cause) {
  const Vec3& p_WB = plant_.truth().state.p_WB;
  const std::string_view name = core::EnumName(cause);
  fallen_ = true;
  CloseChord();
  lying_s_ = 0.0;
  ++result_.falls;
  result_.fall_events.push_back({time_s(), std::string(name), p_WB.head<2>()});
  Announce("fall", fmt::format("{} at x {:.3f} m, y {:.3f} m", name, p_WB.x(), p_WB.y()));
}

void Episode::CloseChord() {
  path_.CloseChord(plant_.truth().state.p_WB.head<2>());
  result_.walked_m = path_.length_m();
}

/// As in the field: the robot is set on its feet on the nearest good ground ahead. If it has not
/// come away from its last place, the next 0.25 m are left out, and twice as much each time that
/// this repeats.
void Episode::PutOnFeet() {
  constexpr double kSamePlace_m = 1.0, kFurther_m = 0.25, kFurthest_m = 2.0;
  CloseChord();
  const RobotState& state = plant_.truth().state;
  const Vec2 here_W = state.p_WB.head<2>();
  const bool same = last_place_W_ && (*last_place_W_ - here_W).norm() < kSamePlace_m;
  further_m_ = same ? std::clamp(2.0 * further_m_, kFurther_m, kFurthest_m) : 0.0;
  const Place place = SetDown({here_W, core::RpyFromRotation(state.R_WB).z()}, further_m_, true);
  last_place_W_ = place.p_WB;
  Announce("placed", fmt::format("at x {:.3f} m, y {:.3f} m", place.p_WB.x(), place.p_WB.y()));
}

/// Puts the robot down at rest near `wanted`, on its feet or folded, where it stands well, and
/// starts a fresh controller. @returns where.
Place Episode::SetDown(const Place& wanted, double ahead_m, bool standing) {
  constexpr double kEdge_m = 1.0;
  const double inside_m = std::max(0.0, ground_.half_size_m() - kEdge_m);
  std::vector<Place> places = operator_.PlacesAhead(wanted, ahead_m);
  for (Place& p : places) p.p_WB = p.p_WB.cwiseMax(-inside_m).cwiseMin(inside_m);
  const auto [place, margin] = ChoosePlace(robot_, ground_, places);
  if (margin <= 0.0) Announce("poor_ground", DescribePoorGround(place));
  operator_.Resume(place);
  plant_.Reset(standing ? PlaceStanding(robot_, ground_, place)
                        : PlaceLying(robot_, ground_, place));
  sensors_.Reset();
  actuation_.Reset();
  fall_detector_.Reset();
  stuck_detector_.Reset();
  path_.Lift();
  StartController(place, standing);
  fallen_ = false;
  operating_s_ = 0.0;
  stand_up_ends_s_ =
      time_s() + controller::CalcStandUpTime(changes_.in_force().stand_up, !standing);
  ++segment_;
  return place;
}

/// A fresh controller, which knows what the one before it learned of the robot's mass.
void Episode::StartController(const Place& place, bool standing) {
  if (controller_) {
    counters_ += controller_->counters();
    retired_ = controller_->output();
  }
  start_ = controller::Start{
      standing ? controller::Start::Pose::kStanding : controller::Start::Pose::kLying,
      {place.p_WB, ground_.HeightAt(place.p_WB.x(), place.p_WB.y()), place.yaw_rad},
      controller_ ? step_ + 1 : 0,
      controller_ ? std::optional(controller_->model()) : std::nullopt};
  controller_ = std::make_unique<controller::Controller>(
      changes_.in_force(), robot_, scenario_.gravity_mps2, scenario_.physics.step_s, *start_);
  for (EpisodeObserver* observer : observers_) observer->OnStart(time_s(), *start_);
}

std::optional<EpisodeEnd> Episode::FindEnd() const {
  if (!IsFinite(plant_.truth().state)) return EpisodeEnd::kNonFinite;
  if (result_.falls > 0 && result_.falls >= scenario_.max_falls) return EpisodeEnd::kFallLimit;
  const auto* route = std::get_if<RouteParams>(&scenario_.operation);
  if (route != nullptr && result_.walked_m >= route->distance_m) return EpisodeEnd::kCompleted;
  return std::nullopt;
}

EpisodeEnd Episode::EndByTime() const {
  const bool programme = std::holds_alternative<VelocityProgramme>(scenario_.operation);
  return programme ? EpisodeEnd::kCompleted : EpisodeEnd::kTimedOut;
}

void Episode::End(EpisodeEnd end) {
  end_ = end;
  const bool ordinary = end == EpisodeEnd::kCompleted || end == EpisodeEnd::kTimedOut;
  if (!ordinary) Announce("end", std::string(core::EnumName(end)));
}

EpisodeResult Episode::Result() const {
  EpisodeResult result = result_;
  result.end = end_.value_or(EndByTime());
  result.duration_s = time_s();
  result.counters = CountersSoFar();
  result.injected = solver_faults_.injected();
  result.unconverged_steps = plant_.unconverged_steps();
  return result;
}

Counters Episode::CountersSoFar() const {
  Counters sum = counters_;
  return sum += controller_->counters();
}

StepRecord Episode::Record() const {
  const sim::Truth& truth = plant_.truth();
  return {step_,
          time_s(),
          truth,
          sensed_,
          command_,
          control(),
          changes_.in_force().gait,
          CountersSoFar(),
          actuation_.energy(),
          actuation_.battery(),
          actuation_.motor_tau_Nm(),
          ground_.HeightAt(truth.state.p_WB.x(), truth.state.p_WB.y()),
          robot_.config.has_foot_sensors,
          fallen_,
          segment_,
          faults_,
          *controller_,
          hashed_ ? std::optional(result_.state_hash) : std::nullopt};
}

void Episode::Announce(const std::string& kind, const std::string& detail) {
  events_.push_back({step_, time_s(), kind, detail});
  for (EpisodeObserver* observer : observers_) observer->OnEvent(events_.back());
}

}  // namespace scoria::app
