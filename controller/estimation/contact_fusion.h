// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/plans.h"

namespace scoria::controller {

struct FusionParams {
  double phase_sigma_s = 0.02;
  double force_mean = 0.05;
  double force_sigma = 0.015;
  double height_mean_m = 0.01;
  double height_sigma_m = 0.05;
  double phase_deviation = 0.25;
  double force_deviation = 0.1;
  double height_deviation = 0.3;
  double hysteresis = 0.05;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("phase_sigma_s", phase_sigma_s,
            {.min = 1e-4,
             .max = 1.0,
             .doc = "scatter of touchdown and lift-off about the plan",
             .scale = core::dimension::kTime});
    a.Field("force_mean", force_mean,
            {.min = 0.0,
             .max = 1.0,
             .doc = "normal force at which contact is as likely as not; share of the weight"});
    a.Field("force_sigma", force_sigma,
            {.min = 1e-4, .max = 1.0, .doc = "its scatter; share of the weight"});
    a.Field("height_mean_m", height_mean_m,
            {.min = -0.5,
             .max = 0.5,
             .doc = "foot over the ground plane, likewise",
             .scale = core::dimension::kLength});
    a.Field("height_sigma_m", height_sigma_m,
            {.min = 1e-4,
             .max = 1.0,
             .doc = "its scatter: how rough the ground is",
             .scale = core::dimension::kLength});
    a.Field(
        "phase_deviation", phase_deviation,
        {.min = 0.01,
         .max = 10.0,
         .doc = "standard deviation of the probability from the phase; weights are 1 / square"});
    a.Field("force_deviation", force_deviation,
            {.min = 0.01, .max = 10.0, .doc = "the same, from the force"});
    a.Field("height_deviation", height_deviation,
            {.min = 0.01, .max = 10.0, .doc = "the same, from the height"});
    a.Field(
        "hysteresis", hysteresis,
        {.min = 0.0, .max = 0.4, .doc = "contact begins above 0.5 + this, ends below 0.5 - this"});
  }
  bool operator==(const FusionParams&) const = default;
};

/// What is known of one foot.
struct FusionInput {
  double phase = 0.0;  // [0, 1), now; stance while below duty
  double duty = 1.0;   // 1: planned to stand for good
  double period_s = 0.5;
  double force = 0.0;     // normal force of the ground on the foot, share of the weight
  double height_m = 0.0;  // of the foot sphere's lowest point over the ground plane
};

/// Planned stance at `phase` with transitions that scatter by `sigma` of the period: the difference
/// of two normal distributions about touchdown (0) and lift-off (duty), periodic.
[[nodiscard]] double CalcPhaseProbability(double phase, double duty, double sigma) noexcept;

/// Probability of contact: those from gait phase, force and height weighted by their precision.
/// That is one Kalman step whose prediction is the phase's and whose measurements are the others;
/// as the state is predicted anew each time (A = 0), nothing is carried over. Source: [Bledt2018];
/// differs: force as a share of the weight, phase scatter in seconds,
/// scalar per leg as no covariance couples legs.
[[nodiscard]] double CalcContactProbability(const FusionParams& params,
                                            const FusionInput& in) noexcept;

/// Whether a foot is in contact, by its probability and what it was before.
[[nodiscard]] bool DecideContact(const FusionParams& params, double probability,
                                 bool before) noexcept;

/// The plan, `age_s` after it was made, of one leg. While standing every foot is planned to stand.
struct PlannedPhase {
  double phase = 0.0, duty = 1.0;
  [[nodiscard]] bool IsStance() const noexcept { return phase < duty; }
};
[[nodiscard]] PlannedPhase AdvancePhase(const ContactPlan& plan, Leg leg, double age_s) noexcept;

}  // namespace scoria::controller
