// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/signals/falls.h"
#include "analysis/signals/path.h"
#include "analysis/signals/stuck.h"
#include "app/episode/episode_result.h"
#include "app/episode/intervention.h"
#include "app/episode/observer.h"
#include "app/episode/operator.h"
#include "app/episode/solver_fault_player.h"
#include "app/episode/timeline.h"
#include "app/scenario/scenario.h"
#include "core/clone_ptr.h"
#include "sim/sensors/sensors.h"

namespace scoria::app {

/// One episode in progress: operator, sensors, controller, actuation and plant, step by step. The
/// same scenario gives the same bits, whatever is recorded.
class Episode {
 public:
  /// Sets the robot down. All arguments are borrowed and must outlive the episode.
  /// Errors: core::ConfigError for what the scenario asks of this robot in vain.
  Episode(const Scenario& scenario, const core::RobotDescription& robot,
          const terrains::Heightfield& ground);

  /// Lets an observer, which is borrowed, see every step from here on. It first hears the events so
  /// far and the placement in force.
  void Attach(EpisodeObserver& observer);

  /// A copy of the whole: plant, sensors, every stage of the controller, operator. It goes on with
  /// the bits that this one would have; observers stay with the original.
  [[nodiscard]] std::unique_ptr<Episode> Clone() const;

  /// Changes what happens from the next step on, and announces it. A change of the controller holds
  /// until the scenario's next one.
  void Intervene(const Intervention& intervention);

  /// One physics step. @pre not ended().
  void Step();
  /// Ends the episode from outside.
  void Interrupt() { End(EpisodeEnd::kInterrupted); }

  [[nodiscard]] bool ended() const noexcept { return end_.has_value(); }
  [[nodiscard]] std::int64_t step() const noexcept { return step_; }  // the next one
  [[nodiscard]] double time_s() const noexcept {
    return static_cast<double>(step_) * scenario_.physics.step_s;
  }
  [[nodiscard]] core::EventClock clock() const noexcept {
    return {walking_s_, result_.walked_m, time_s()};
  }
  /// The last step. @pre there was one.
  [[nodiscard]] StepRecord last() const { return Record(); }
  [[nodiscard]] std::uint64_t state_hash() const noexcept { return result_.state_hash; }
  [[nodiscard]] const std::vector<EpisodeEvent>& events() const noexcept { return events_; }
  /// So far. Its end is kTimedOut (with a velocity programme kCompleted) while it has not ended.
  [[nodiscard]] EpisodeResult Result() const;

 private:
  Episode(const Episode&) = default;
  void Apply(const FrictionScale& friction) { plant_.SetFrictionScale(friction.factor); }
  void Apply(const TorqueLimitScale& limits) { actuation_.SetTorqueLimitScale(limits.factor); }
  void Apply(const PayloadOff&);
  void Apply(const TruthFor& stages) { truth_for_ = stages; }
  void Apply(const controller::ControllerParams& params);
  [[nodiscard]] controller::TrueInputs TrueInputsNow() const;
  [[nodiscard]] Command NextCommand();
  void MakeChanges();
  void Show();
  void UpdateHash();
  void Announce(const std::string& kind, const std::string& detail);
  void AnnounceSensors();
  void CheckRobot();
  void Fall(analysis::FallCause cause);
  void PutOnFeet();
  Place SetDown(const Place& wanted, double ahead_m, bool standing);
  void StartController(const Place& place, bool standing);
  void CloseChord();
  [[nodiscard]] std::optional<EpisodeEnd> FindEnd() const;
  void End(EpisodeEnd end);
  [[nodiscard]] EpisodeEnd EndByTime() const;
  [[nodiscard]] bool control_in_charge() const noexcept { return operating_s_ > 0.0; }
  [[nodiscard]] Counters CountersSoFar() const;
  [[nodiscard]] StepRecord Record() const;
  [[nodiscard]] const controller::ControlOutput& control() const {
    return retired_ ? *retired_ : controller_->output();
  }

  const Scenario& scenario_;
  const core::RobotDescription& robot_;
  const terrains::Heightfield& ground_;
  std::vector<EpisodeObserver*> observers_;

  sim::Plant plant_;
  sim::PayloadRack payloads_;
  sim::Actuation actuation_;
  sim::Sensors sensors_;
  Operator operator_;
  SolverFaultPlayer solver_faults_;
  Pushes pushes_;
  ControllerChanges changes_;
  analysis::FallDetector fall_detector_;
  analysis::StuckDetector stuck_detector_;
  analysis::PathLength path_;
  std::optional<controller::Start> start_;  // the placement in force
  core::ClonePtr<controller::Controller> controller_;
  TruthFor truth_for_;

  // The last step.
  SensorFrame sensed_;
  Command command_;
  controller::SolverFaults faults_;
  std::optional<controller::ControlOutput> retired_;  // of a controller replaced in that step
  bool hashed_ = false;

  const std::int64_t limit_;  // steps
  const int row_every_;
  const bool give_truth_;
  std::int64_t step_ = 0;
  std::optional<EpisodeEnd> end_;
  std::uint32_t segment_ = 0;
  double operating_s_ = 0.0;  // since the controller took over, this placement
  double walking_s_ = 0.0;    // in which the operator commanded, since the start
  double lying_s_ = 0.0;
  double further_m_ = 0.0;  // than where it fell, the robot was put last
  double stand_up_ends_s_ = 0.0;
  bool fallen_ = false;
  std::optional<Vec2> last_place_W_;
  LegArray<ContactSource> contact_source_;
  Counters counters_;  // of controllers before the present one
  std::vector<EpisodeEvent> events_;
  EpisodeResult result_;
};

}  // namespace scoria::app
