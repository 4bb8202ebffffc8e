// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "controller/estimation/contact_fusion.h"
#include "controller/estimation/foot_sensor.h"
#include "controller/model/momentum_observer.h"
#include "core/config/field.h"
#include "core/robot/contact.h"
#include "core/robot/description.h"
#include "core/robot/plans.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Where contacts come from. Hierarchy: per foot, the sensor while it is healthy, else the
/// observer.
enum class ContactChoice { kHierarchy, kSensor, kMomentumObserver, kGaitPhase, kTruth };
constexpr std::array<std::pair<ContactChoice, std::string_view>, 5> EnumNames(ContactChoice) {
  return {{{ContactChoice::kHierarchy, "hierarchy"},
           {ContactChoice::kSensor, "sensor"},
           {ContactChoice::kMomentumObserver, "momentum_observer"},
           {ContactChoice::kGaitPhase, "gait_phase"},
           {ContactChoice::kTruth, "truth"}}};
}

struct ContactParams {
  ContactChoice source = ContactChoice::kHierarchy;
  double touchdown_delay_s = 0.0;
  ObserverParams observer;
  FusionParams fusion;
  FootSensorParams sensor;
  HealthParams health;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("source", source,
            {.doc = "where contacts come from. hierarchy: the foot sensor while healthy, else the "
                    "momentum "
                    "observer; sensor: that, healthy or not, or the observer on a robot without"});
    a.Field("touchdown_delay_s", touchdown_delay_s,
            {.min = 0.0,
             .max = 0.5,
             .doc = "truth: a foot counts as touching only after so long on the ground"});
    a.Field("observer", observer);
    a.Field("fusion", fusion);
    a.Field("sensor", sensor);
    a.Field("health", health);
  }
  bool operator==(const ContactParams&) const = default;
};

/// @returns true if the choice needs SensorFrame::truth.
[[nodiscard]] bool NeedsTruth(const ContactParams& params) noexcept;

struct ContactInput {
  const SensorFrame& z;
  const core::WholeBody& wb;  // at this tick's state or the last one's
  const ContactPlan& plan;
  double plan_age_s = 0.0;  // since `plan` was made
  GroundPlane plane;
  double foot_radius_m = 0.0;
};

/// Contact of each foot from all sources. Every source is followed in every tick, whichever is
/// chosen, so that a log can compare them and a change of choice finds them settled.
/// Source: [Bledt2018] for observer and fusion; the hierarchy is the Paper's.
class ContactEstimator {
 public:
  /// `robot` is borrowed. `step_s` is the time between calls of Update.
  ContactEstimator(const ContactParams& params, const core::RobotDescription& robot,
                   double gravity_mps2, double step_s) noexcept;

  [[nodiscard]] ContactEstimate Update(const ContactInput& in) noexcept;

  /// Changes where contacts come from, at run time; nothing that was learned is lost.
  void SetChoice(ContactChoice source) noexcept { params_.source = source; }

 private:
  void UpdateObserver(const ContactInput& in) noexcept;
  void UpdateSensors(const ContactInput& in) noexcept;
  void UpdateTruth(const SensorFrame& z) noexcept;
  [[nodiscard]] ContactSource Choose(Leg leg) const noexcept;
  [[nodiscard]] bool Word(ContactSource source, Leg leg, const ContactInput& in) const noexcept;

  ContactParams params_;
  bool has_sensors_;
  double gravity_mps2_, step_s_;
  std::int64_t delay_steps_;
  MomentumObserver observer_;
  LegArray<FootSensor> sensors_;
  LegArray<SensorHealth> health_;
  LegArray<double> unloaded_s_;  // how long the observer has been sure that the foot is up
  LegArray<double> force_N_;     // along the ground's normal
  LegArray<std::int64_t> touching_steps_;
  LegArray<bool> truth_;
  ContactEstimate out_;
};

}  // namespace scoria::controller
