// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/config/field.h"

namespace scoria::controller {

/// How the problem is put to a solver. All three have the same solution.
enum class TsidFormulation { kNullspace, kReduced, kFull };
constexpr std::array<std::pair<TsidFormulation, std::string_view>, 3> EnumNames(TsidFormulation) {
  return {{{TsidFormulation::kNullspace, "nullspace"},
           {TsidFormulation::kReduced, "reduced"},
           {TsidFormulation::kFull, "full"}}};
}

struct TsidParams {
  static constexpr const char* kType = "tsid";
  TsidFormulation formulation = TsidFormulation::kNullspace;
  double com_weight = 1.0, orientation_weight = 1.0, swing_weight = 1.0;
  double force_weight = 0.1;
  double regularisation = 1e-6;
  double com_kp = 100.0, com_kd = 20.0;
  double orientation_kp = 200.0, orientation_kd = 20.0;
  double swing_kp = 1200.0, swing_kd = 60.0, max_swing_acceleration_mps2 = 200.0;
  double contact_damping_per_s = 30.0;
  double friction = 0.45;
  double f_min_N = 2.0;
  double target_lead_s = 0.05;
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kMaxWeight = 1e6, kMaxGain = 1e5;
    a.Field(
        "formulation", formulation,
        {.doc = "nullspace: 12 unknowns, no equalities; reduced: accelerations and forces; full: "
                "and torques. One problem, three forms"});
    a.Field("com_weight", com_weight, {.min = 0.0, .max = kMaxWeight, .doc = "per (m/s^2)^2"});
    a.Field("orientation_weight", orientation_weight,
            {.min = 0.0,
             .max = kMaxWeight,
             .doc = "per (rad/s^2)^2",
             .scale = core::Pow(core::dimension::kTime, 4.0)});
    a.Field("swing_weight", swing_weight, {.min = 0.0, .max = kMaxWeight, .doc = "per (m/s^2)^2"});
    a.Field("force_weight", force_weight,
            {.min = 0.0,
             .max = kMaxWeight,
             .doc = "per N^2",
             .scale = core::Pow(core::dimension::kForce, -2.0)});
    a.Field("regularisation", regularisation, {.min = 1e-12, .max = 1.0});
    a.Field("com_kp", com_kp,
            {.min = 0.0,
             .max = kMaxGain,
             .doc = "1/s^2",
             .scale = core::Pow(core::dimension::kTime, -2.0)});
    a.Field("com_kd", com_kd,
            {.min = 0.0, .max = kMaxGain, .doc = "1/s", .scale = core::dimension::kRate});
    a.Field("orientation_kp", orientation_kp,
            {.min = 0.0, .max = kMaxGain, .scale = core::Pow(core::dimension::kTime, -2.0)});
    a.Field("orientation_kd", orientation_kd,
            {.min = 0.0, .max = kMaxGain, .scale = core::dimension::kRate});
    a.Field("swing_kp", swing_kp,
            {.min = 0.0, .max = kMaxGain, .scale = core::Pow(core::dimension::kTime, -2.0)});
    a.Field("swing_kd", swing_kd, {.min = 0.0, .max = kMaxGain, .scale = core::dimension::kRate});
    a.Field("max_swing_acceleration_mps2", max_swing_acceleration_mps2, {.min = 1.0, .max = 1e4});
    a.Field("contact_damping_per_s", contact_damping_per_s,
            {.min = 0.0,
             .max = 80.0,
             .doc = "brakes a slipping foot; unstable near 100 at 500 Hz",
             .scale = core::dimension::kRate});
    a.Field("friction", friction, {.min = 0.05, .max = 2.0, .doc = "assumed, of the pyramid"});
    a.Field("f_min_N", f_min_N, {.min = 0.0, .max = 1e3, .scale = core::dimension::kForce});
    a.Field("target_lead_s", target_lead_s,
            {.min = 0.0,
             .max = 0.2,
             .doc = "how far ahead on the MPC's predicted motion the body target lies",
             .scale = core::dimension::kTime});
  }
  bool operator==(const TsidParams&) const = default;
};

}  // namespace scoria::controller
