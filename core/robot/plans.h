// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/robot/legs.h"

/// Value types by which the controller's stages meet. Fixed size: a copy is a snapshot.
namespace scoria {

inline constexpr int kMaxHorizon = 20;

/// When each foot shall be on the ground, from the gait stage.
struct ContactPlan {
  int horizon = 0;       // MPC stages that are filled below
  double dt_s = 0.05;    // duration of one stage
  bool standing = true;  // all feet stay down until commanded otherwise
  double period_s = 0.5;
  LegArray<double> duty;                                 // stance share of the period
  LegArray<double> offset;                               // desired phase offsets
  LegArray<double> phase;                                // [0, 1); stance while phase < duty
  LegArray<bool> stance;                                 // now
  LegArray<double> stance_s;                             // duration of a whole stance
  LegArray<double> swing_s;                              // duration of a whole swing
  LegArray<double> swing_remaining_s;                    // until touchdown; 0 in stance
  std::array<LegArray<bool>, kMaxHorizon> stage_stance;  // at k dt_s from now
};

/// Desired body motion over the horizon. Angles are roll, pitch, yaw with yaw continuous; C is the
/// COM.
struct BodyReference {
  struct Stage {
    Vec3 rpy_rad = Vec3::Zero();
    Vec3 p_WC = Vec3::Zero();
    Vec3 w_WB = Vec3::Zero();
    Vec3 v_WC = Vec3::Zero();
  };
  std::array<Stage, kMaxHorizon + 1> stages;
  /// The ground below the robot: unit normal and height (z of W) under the COM.
  Vec3 n_W = Vec3::UnitZ();
  double ground_z_m = 0.0;
};

/// Ground plane through the last footholds: z = z0 + slope . (xy - origin).
struct GroundPlane {
  Vec2 origin = Vec2::Zero();
  double z0_m = 0.0;
  Vec2 slope = Vec2::Zero();
  [[nodiscard]] double Height(const Vec3& p_W) const noexcept {
    return z0_m + slope.dot(p_W.head<2>() - origin);
  }
  [[nodiscard]] Vec3 Normal() const noexcept {
    return Vec3(-slope.x(), -slope.y(), 1.0).normalized();
  }
};

/// Where each foot (sphere centre) stands or will stand, per MPC stage.
struct FootholdPlan {
  LegArray<Vec3> next =
      ZeroPerLeg();  // p_WF of the touchdown that the current or coming swing aims at
  std::array<LegArray<Vec3>, kMaxHorizon> stage;
  GroundPlane plane;  // that the footholds lie on
};

/// Ground forces on the feet and the body motion that they produce, from the MPC: the first stages
/// of its horizon.
struct ForcePlan {
  static constexpr int kStages = 4;
  std::array<LegArray<Vec3>, kStages> f_F_W;       // N, held over each stage
  std::array<LegArray<bool>, kStages> stance;      // the contact set each stage was solved for
  std::array<BodyReference::Stage, kStages> body;  // predicted body at the start of each stage
  LegArray<Vec3> f_next_F_W = ZeroPerLeg();  // N, the first stage at which each foot is in stance
  double dt_s = 0.05;
  bool valid = false;

  /// Forces for the feet that stand now: those of the first stage with that very contact set, else
  /// each foot's next force, scaled so that their sum along `n_W` is that of the first stage.
  [[nodiscard]] LegArray<Vec3> ForcesFor(const LegArray<bool>& contact,
                                         const Vec3& n_W) const noexcept;

  /// The predicted body, interpolated, `ahead_s` after the state that the plan was made from.
  [[nodiscard]] BodyReference::Stage BodyAfter(double ahead_s) const noexcept;
};

/// Axes of the ground: z along its normal, x along the heading. Friction pyramids are aligned with
/// it.
[[nodiscard]] Mat3 GroundFrame(const Vec3& n_W, double yaw_rad) noexcept;

/// What a leg does. Bears force: stance, and a swing foot that touched early. In the air: swing,
/// its lift over an obstacle, and a foot that ought to stand, lowered until it touches or held in
/// the body frame.
enum class LegMode { kStance, kSwing, kEarlyContact, kLowering, kHolding, kStumble };

/// The contact set that the body controllers act on: the plan corrected by what the feet sensed.
struct LegPhases {
  LegArray<LegMode> mode{LegMode::kStance};
  LegArray<double> swing_progress;  // 0 lift-off .. 1 planned touchdown
  LegArray<double> swing_s{0.2};
  LegArray<double> late_s;  // how long a foot that ought to stand has been in the air
  [[nodiscard]] bool InContact(Leg leg) const noexcept {
    return mode[leg] == LegMode::kStance || mode[leg] == LegMode::kEarlyContact;
  }
  [[nodiscard]] LegArray<bool> Contacts() const noexcept {
    return {InContact(Leg::kFL), InContact(Leg::kFR), InContact(Leg::kHL), InContact(Leg::kHR)};
  }
};

/// Where the foot centre shall be now.
struct FootTarget {
  Vec3 p_WF = Vec3::Zero(), v_WF = Vec3::Zero(), a_WF = Vec3::Zero();
  bool operator==(const FootTarget&) const = default;
};
using FootTargets = LegArray<FootTarget>;

}  // namespace scoria
