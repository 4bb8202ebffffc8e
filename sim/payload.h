// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/config/archive.h"
#include "core/event_clock.h"
#include "core/robot/payload_body.h"
#include "core/robot/whole_body.h"

namespace scoria::sim {

using core::PayloadParams;
using core::SpatialInertia;
using core::ToInertia;

/// The trunk with bodies fixed to it: mass, centre of mass and inertia of them all. Massless bodies
/// leave no trace, not even in the last bit.
[[nodiscard]] SpatialInertia AddBodies(const SpatialInertia& trunk,
                                       std::span<const SpatialInertia> bodies) noexcept;

enum class PayloadAction { kAdd, kMove, kRemove, kShed };
constexpr std::array<std::pair<PayloadAction, std::string_view>, 4> EnumNames(PayloadAction) {
  return {{{PayloadAction::kAdd, "add"},
           {PayloadAction::kMove, "move"},
           {PayloadAction::kRemove, "remove"},
           {PayloadAction::kShed, "shed"}}};
}

/// How a body moved just before it became part of the robot: with the trunk, or not at all.
enum class AttachVelocity { kMatched, kRest };
constexpr std::array<std::pair<AttachVelocity, std::string_view>, 2> EnumNames(AttachVelocity) {
  return {{{AttachVelocity::kMatched, "matched"}, {AttachVelocity::kRest, "rest"}}};
}

/// A change of what the trunk carries, at a time or at a distance.
struct PayloadEvent {
  std::optional<double> at_s, distance_m;
  PayloadAction action = PayloadAction::kAdd;
  std::optional<PayloadParams> body;
  std::string payload;
  std::optional<Vec3> p_BP_m, rpy_rad;
  double share = 0.0;
  double duration_s = 0.0;
  AttachVelocity attach_velocity = AttachVelocity::kMatched;
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kFar_m = 1e6, kLong_s = 1e6, kNone = 0.0;
    a.Field("at_s", at_s, {.min = kNone, .max = kLong_s, .doc = "since the robot stands"});
    a.Field("distance_m", distance_m,
            {.min = kNone, .max = kFar_m, .doc = "walked; in place of at_s"});
    a.Required("action", action);
    a.Field("body", body, {.doc = "add: usually base: ../robots/payloads/NAME.yaml"});
    a.Field("payload", payload, {.doc = "move, remove, shed: name of a body that was added"});
    a.Field("p_BP_m", p_BP_m,
            {.min = -2.0, .max = 2.0, .doc = "move: where its centre of mass goes"});
    a.Field("rpy_rad", rpy_rad, {.doc = "move: how it turns; neither key: as it was"});
    a.Field("share", share, {.min = kNone, .max = 1.0, .doc = "shed: part of the mass it loses"});
    a.Field("duration_s", duration_s,
            {.min = kNone, .max = kLong_s, .doc = "0: at once, else at a constant rate"});
    a.Field("attach_velocity", attach_velocity,
            {.doc = "add: the body moved with the trunk (matched) or stood still (rest), so that "
                    "the robot has to drag it along"});
  }
  [[nodiscard]] std::string Problem() const;
  /// Of the body that it concerns.
  [[nodiscard]] const std::string& name() const noexcept { return body ? body->name : payload; }
  bool operator==(const PayloadEvent&) const = default;
};

/// What is wrong with events together, empty if nothing: each may concern only bodies that are
/// added.
[[nodiscard]] std::string PayloadProblem(std::span<const PayloadEvent> events);

/// What the trunk's inertia changes to.
struct TrunkChange {
  SpatialInertia trunk;
  AttachVelocity attach_velocity = AttachVelocity::kMatched;
  bool operator==(const TrunkChange&) const = default;
};

/// The payloads on the trunk and the events that change them. The inertia is always composed anew
/// from the bare trunk and the bodies in the order in which they were added, so a trunk that lost
/// them all is the bare one bit for bit.
class PayloadRack {
 public:
  /// @pre  PayloadProblem(events) is empty, and Problem() of each.
  PayloadRack(const SpatialInertia& bare_trunk, std::vector<PayloadEvent> events);

  /// Begins events whose time has come, and goes on with gradual ones.
  /// @returns the changes to make, in order; none, one, or two if some bodies moved with the trunk
  ///          and some did not.
  [[nodiscard]] std::vector<TrunkChange> Update(const core::EventClock& now);

  /// Takes every body off at once, as a `remove` does, and calls off what is still to come.
  /// @returns the change to make, none if nothing is on the trunk.
  [[nodiscard]] std::optional<TrunkChange> RemoveAll();

  /// What each event that began in the last Update does, or why it does nothing.
  [[nodiscard]] const std::vector<std::string>& announcements() const noexcept {
    return announcements_;
  }

 private:
  /// Runs from 0 to 1.
  struct Ramp {
    double begin_s = 0.0, duration_s = 0.0;
    [[nodiscard]] double At(double time_s) const noexcept;
  };
  struct Item {
    PayloadParams body;
    SpatialInertia whole;  // of the unharmed body, where it was added
    Ramp share_ramp, pose_ramp;
    double share_from = 0.0, share_to = 1.0;
    Vec3 p_BP_from = Vec3::Zero(), p_BP_to = Vec3::Zero();
    Quat q_from = Quat::Identity(), q_to = Quat::Identity();
    AttachVelocity attach_velocity = AttachVelocity::kMatched;
    SpatialInertia now;
    [[nodiscard]] double ShareAt(double time_s) const noexcept;
    [[nodiscard]] Vec3 PositionAt(double time_s) const noexcept;
    [[nodiscard]] Quat TurnAt(double time_s) const noexcept;
    [[nodiscard]] SpatialInertia At(double time_s) const noexcept;
    [[nodiscard]] bool IsGone(double time_s) const noexcept;
  };

  [[nodiscard]] std::string Begin(const PayloadEvent& event, double begin_s);
  [[nodiscard]] std::string Add(const PayloadEvent& event, const Ramp& ramp);
  [[nodiscard]] std::string Move(const PayloadEvent& event, const Ramp& ramp, Item& item);
  [[nodiscard]] std::string Lose(const PayloadEvent& event, const Ramp& ramp, Item& item);
  [[nodiscard]] SpatialInertia Compose() const;

  SpatialInertia bare_trunk_, trunk_;
  std::vector<PayloadEvent> events_;
  std::vector<core::EventTimer> timers_;  // of the events
  std::vector<Item> items_;
  std::vector<std::string> announcements_;
};

}  // namespace scoria::sim
