// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "core/config/field.h"

namespace scoria::controller {

/// From what is learned to what gait, MPC and WBC are told.
struct UpdateGateParams {
  double max_sigma_kg = 0.3, max_sigma_kgm = 0.03;
  double rate_kgps = 10.0, rate_kgmps = 1.0;
  double payload_height_m = 0.1;
  double min_trunk_share = 0.3, max_payload_kg = 15.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("max_sigma_kg", max_sigma_kg,
            {.min = 0.0,
             .max = 100.0,
             .doc = "a mass less sure than this does not enter the model",
             .scale = core::dimension::kMass});
    a.Field("max_sigma_kgm", max_sigma_kgm,
            {.min = 0.0,
             .max = 10.0,
             .doc = "likewise of mass times offset of the COM",
             .scale = core::dimension::kMassMoment});
    a.Field("rate_kgps", rate_kgps,
            {.min = 0.0,
             .max = 1000.0,
             .doc = "fastest change of the model's mass",
             .scale = core::dimension::kMass / core::dimension::kTime});
    a.Field("rate_kgmps", rate_kgmps,
            {.min = 0.0,
             .max = 100.0,
             .doc = "of its mass times offset of the COM",
             .scale = core::dimension::kMassMoment / core::dimension::kTime});
    a.Field("payload_height_m", payload_height_m,
            {.min = -1.0,
             .max = 1.0,
             .doc = "over B, where what is added is taken to be",
             .scale = core::dimension::kLength});
    a.Field("min_trunk_share", min_trunk_share,
            {.min = 0.05, .max = 1.0, .doc = "least mass of the trunk over the nominal one"});
    a.Field("max_payload_kg", max_payload_kg,
            {.min = 0.0, .max = 100.0, .scale = core::dimension::kMass});
  }
  bool operator==(const UpdateGateParams&) const = default;
};

/// The nominal model for good.
struct NoAdaptationParams {
  static constexpr const char* kType = "none";
  template <class Archive>
  void Serialize(Archive&) {}
  bool operator==(const NoAdaptationParams&) const = default;
};

/// What the torques of a leg tell of the force on its foot.
enum class LegForces { kMassless, kWeight, kObserver };
constexpr std::array<std::pair<LegForces, std::string_view>, 3> EnumNames(LegForces) {
  return {{{LegForces::kMassless, "massless"},
           {LegForces::kWeight, "weight"},
           {LegForces::kObserver, "observer"}}};
}

/// The paper's Kalman filter; its covariances are not published.
struct AdaptationKfParams {
  static constexpr const char* kType = "kf";
  double rate_Hz = 100.0;
  LegForces leg_forces = LegForces::kMassless;
  bool acceleration = true;
  double walk_kg_per_sqrts = 0.2, walk_kgm_per_sqrts = 0.02;
  double force_N = 30.0, moment_Nm = 6.0;
  double initial_kg = 2.0, initial_kgm = 0.2;
  UpdateGateParams update_gate;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rate_Hz", rate_Hz, {.min = 1.0, .max = 1000.0});
    a.Field("leg_forces", leg_forces,
            {.doc = "massless: the paper's J^-T tau; weight: less what holds the legs at rest; "
                    "observer: the momentum observer's, less their motion and friction, too"});
    a.Field("acceleration", acceleration,
            {.doc = "false: the paper's balance with the trunk as if it did not accelerate"});
    a.Field("walk_kg_per_sqrts", walk_kg_per_sqrts,
            {.min = 0.0,
             .max = 100.0,
             .doc = "random walk of the mass",
             .scale = core::dimension::kMass / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("walk_kgm_per_sqrts", walk_kgm_per_sqrts,
            {.min = 0.0,
             .max = 10.0,
             .doc = "of the mass times offset of the COM",
             .scale = core::dimension::kMassMoment / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("force_N", force_N,
            {.min = 1e-3,
             .max = 1e4,
             .doc = "standard deviation of an update's force",
             .scale = core::dimension::kForce});
    a.Field("moment_Nm", moment_Nm, {.min = 1e-3, .max = 1e4, .scale = core::dimension::kTorque});
    a.Field("initial_kg", initial_kg, {.min = 1e-6, .max = 100.0, .scale = core::dimension::kMass});
    a.Field("initial_kgm", initial_kgm,
            {.min = 1e-6, .max = 10.0, .scale = core::dimension::kMassMoment});
    a.Field("update_gate", update_gate, {.was = "hand_over"});
  }
  bool operator==(const AdaptationKfParams&) const = default;
};

/// Recursive least squares with exponential forgetting.
struct RlsParams {
  static constexpr const char* kType = "rls";
  double rate_Hz = 100.0;
  double memory_s = 2.0;
  double force_N = 30.0, moment_Nm = 6.0;
  double initial_kg = 2.0, initial_kgm = 0.2;
  UpdateGateParams update_gate;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rate_Hz", rate_Hz, {.min = 1.0, .max = 1000.0});
    a.Field("memory_s", memory_s,
            {.min = 0.01,
             .max = 1e4,
             .doc = "after which a measurement counts 1/e",
             .scale = core::dimension::kTime});
    a.Field("force_N", force_N, {.min = 1e-3, .max = 1e4, .scale = core::dimension::kForce});
    a.Field("moment_Nm", moment_Nm, {.min = 1e-3, .max = 1e4, .scale = core::dimension::kTorque});
    a.Field("initial_kg", initial_kg,
            {.min = 1e-6,
             .max = 100.0,
             .doc = "also the most that forgetting can forget",
             .scale = core::dimension::kMass});
    a.Field("initial_kgm", initial_kgm,
            {.min = 1e-6, .max = 10.0, .scale = core::dimension::kMassMoment});
    a.Field("update_gate", update_gate, {.was = "hand_over"});
  }
  bool operator==(const RlsParams&) const = default;
};

/// Sees that the payload has changed: CUSUM over the innovations.
struct StepDetectionParams {
  double smooth_s = 0.4;
  double drift_kg = 0.4, drift_kgm = 0.04;
  double threshold_s = 0.2;
  double refill_s = 0.6;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("smooth_s", smooth_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "low pass over the ripple of the gait",
             .scale = core::dimension::kTime});
    a.Field("drift_kg", drift_kg,
            {.min = 1e-3,
             .max = 100.0,
             .doc = "an error below this is never a change",
             .scale = core::dimension::kMass});
    a.Field("drift_kgm", drift_kgm,
            {.min = 1e-4, .max = 10.0, .scale = core::dimension::kMassMoment});
    a.Field("threshold_s", threshold_s,
            {.min = 1e-3,
             .max = 10.0,
             .doc = "an error of twice the drift is a change after this time",
             .scale = core::dimension::kTime});
    a.Field("refill_s", refill_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "after a change: no other is looked for",
             .scale = core::dimension::kTime});
  }
  bool operator==(const StepDetectionParams&) const = default;
};

/// A robot that only stands hangs partly on the friction of its joints, unknown until they have
/// slid: tare it while it moves, by walking or by going up and down, or the tare is off by a few
/// tenths of a kilogram for a Go2.
struct TareParams {
  bool enabled = true;
  double duration_s = 10.0;
  double gain_share = 0.7;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("enabled", enabled,
            {.doc = "the robot starts unloaded: learn what the torques misread"});
    a.Field("duration_s", duration_s,
            {.min = 0.1,
             .max = 600.0,
             .doc = "of work, better in motion",
             .scale = core::dimension::kTime});
    a.Field("gain_share", gain_share,
            {.min = 0.0,
             .max = 1.0,
             .doc = "of the misreading that grows with the load; the rest is offset"});
  }
  bool operator==(const TareParams&) const = default;
};

/// Kalman filter over the full floating-base dynamics.
struct KfPlusParams {
  static constexpr const char* kType = "kf_plus";
  double rate_Hz = 100.0;
  double start_s = 0.5;
  double walk_kg_per_sqrts = 0.06, walk_kgm_per_sqrts = 0.006;
  double force_N = 20.0, moment_Nm = 4.0;
  double huber = 2.0;
  double initial_kg = 3.0, initial_kgm = 0.3;
  double presliding_rad = 0.001;
  StepDetectionParams step;
  TareParams tare;
  UpdateGateParams update_gate;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rate_Hz", rate_Hz, {.min = 1.0, .max = 1000.0});
    a.Field("start_s", start_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "work before the readings are believed",
             .scale = core::dimension::kTime});
    a.Field("walk_kg_per_sqrts", walk_kg_per_sqrts,
            {.min = 0.0,
             .max = 100.0,
             .scale = core::dimension::kMass / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("walk_kgm_per_sqrts", walk_kgm_per_sqrts,
            {.min = 0.0,
             .max = 10.0,
             .scale = core::dimension::kMassMoment / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("force_N", force_N,
            {.min = 1e-3,
             .max = 1e4,
             .doc = "standard deviation of an update's force",
             .scale = core::dimension::kForce});
    a.Field("moment_Nm", moment_Nm, {.min = 1e-3, .max = 1e4, .scale = core::dimension::kTorque});
    a.Field(
        "huber", huber,
        {.min = 0.1, .max = 1e3, .doc = "standard deviations from which on an error counts less"});
    a.Field("initial_kg", initial_kg, {.min = 1e-6, .max = 100.0, .scale = core::dimension::kMass});
    a.Field("initial_kgm", initial_kgm,
            {.min = 1e-6, .max = 10.0, .scale = core::dimension::kMassMoment});
    a.Field(
        "presliding_rad", presliding_rad,
        {.min = 0.0,
         .max = 0.1,
         .doc = "a joint at rest keeps its friction until it has turned so far; 0: it loses it"});
    a.Field("step", step);
    a.Field("tare", tare);
    a.Field("update_gate", update_gate, {.was = "hand_over"});
  }
  bool operator==(const KfPlusParams&) const = default;
};

using AdapterParams = std::variant<NoAdaptationParams, AdaptationKfParams, RlsParams, KfPlusParams>;

}  // namespace scoria::controller
