// SPDX-License-Identifier: BSD-3-Clause
#include "sim/payload.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/demand.h"
#include "core/math/so3.h"

namespace scoria::sim {
namespace {

std::string Text(const Vec3& p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", p[0], p[1], p[2]);
}

std::string Over(double duration_s) {
  return duration_s > 0.0 ? fmt::format(" over {:g} s", duration_s) : "";
}

/// The first key of the event that its action has no use for.
std::string_view StrayKey(const PayloadEvent& e) {
  const bool adds = e.action == PayloadAction::kAdd, moves = e.action == PayloadAction::kMove;
  if (!adds && e.body) return "body";
  if (adds && !e.payload.empty()) return "payload";
  if (!moves && e.p_BP_m) return "p_BP_m";
  if (!moves && e.rpy_rad) return "rpy_rad";
  if (e.action != PayloadAction::kShed && e.share != 0.0) return "share";
  return "";
}

}  // namespace

std::string PayloadEvent::Problem() const {
  const std::string_view verb = core::EnumName(action);
  if (at_s.has_value() == distance_m.has_value()) return "needs one of at_s and distance_m";
  if (action == PayloadAction::kAdd && !body) return "body: add needs one";
  if (action != PayloadAction::kAdd && payload.empty())
    return fmt::format("payload: {} needs the name of one", verb);
  if (const std::string_view key = StrayKey(*this); !key.empty())
    return fmt::format("{}: {} has none", key, verb);
  if (action == PayloadAction::kMove && !p_BP_m && !rpy_rad)
    return "move needs p_BP_m, rpy_rad or both";
  if (action == PayloadAction::kShed && !(share > 0.0 && share < 1.0))
    return "share: shed needs one in (0, 1); remove takes all";
  if (action != PayloadAction::kAdd && attach_velocity == AttachVelocity::kRest)
    return fmt::format("attach_velocity: rest is for add; what {} concerns moves with the trunk",
                       verb);
  return "";
}

SpatialInertia AddBodies(const SpatialInertia& trunk,
                         std::span<const SpatialInertia> bodies) noexcept {
  SpatialInertia out = trunk;
  Vec3 moment = trunk.mass_kg * trunk.p_OC;
  for (const SpatialInertia& body : bodies) {
    out.mass_kg += body.mass_kg;
    moment += body.mass_kg * body.p_OC;
  }
  // Also where all bodies are massless: moment / mass need not give back the bare trunk's COM.
  if (out.mass_kg == trunk.mass_kg) return trunk;
  out.p_OC = moment / out.mass_kg;
  out.I_C += core::PointInertia(trunk.mass_kg, trunk.p_OC - out.p_OC);
  for (const SpatialInertia& body : bodies) {
    out.I_C += body.I_C + core::PointInertia(body.mass_kg, body.p_OC - out.p_OC);
  }
  return out;
}

std::string PayloadProblem(std::span<const PayloadEvent> events) {
  const auto adds = [](const PayloadEvent& e) { return e.action == PayloadAction::kAdd; };
  for (const PayloadEvent& event : events) {
    const auto adds_it = [&](const PayloadEvent& e) { return adds(e) && e.name() == event.name(); };
    if (std::any_of(events.begin(), events.end(), adds_it)) continue;
    std::string names;
    for (const PayloadEvent& e : events) {
      if (adds(e)) names += (names.empty() ? "" : ", ") + e.name();
    }
    return fmt::format("payload: nothing adds \"{}\"; added: {}", event.name(),
                       names.empty() ? "none" : names);
  }
  return "";
}

double PayloadRack::Ramp::At(double time_s) const noexcept {
  return duration_s > 0.0 ? std::clamp((time_s - begin_s) / duration_s, 0.0, 1.0) : 1.0;
}

// The ends are exact: from + 1 (to − from) need not be `to`.
double PayloadRack::Item::ShareAt(double time_s) const noexcept {
  const double t = share_ramp.At(time_s);
  return t < 1.0 ? share_from + t * (share_to - share_from) : share_to;
}

Vec3 PayloadRack::Item::PositionAt(double time_s) const noexcept {
  const double t = pose_ramp.At(time_s);
  return t < 1.0 ? Vec3(p_BP_from + t * (p_BP_to - p_BP_from)) : p_BP_to;
}

Quat PayloadRack::Item::TurnAt(double time_s) const noexcept {
  const double t = pose_ramp.At(time_s);
  return t < 1.0 ? q_from.slerp(t, q_to) : q_to;
}

SpatialInertia PayloadRack::Item::At(double time_s) const noexcept {
  const double share = ShareAt(time_s);
  const Quat turn = TurnAt(time_s);
  SpatialInertia out{share * whole.mass_kg, PositionAt(time_s), share * whole.I_C};
  if (turn.coeffs() == Quat::Identity().coeffs()) return out;
  const Mat3 R = turn.toRotationMatrix();
  out.I_C = R * out.I_C * R.transpose();
  return out;
}

bool PayloadRack::Item::IsGone(double time_s) const noexcept {
  return share_to == 0.0 && ShareAt(time_s) == 0.0;
}

PayloadRack::PayloadRack(const SpatialInertia& bare_trunk, std::vector<PayloadEvent> events)
    : bare_trunk_(bare_trunk),
      trunk_(bare_trunk),
      events_(std::move(events)),
      timers_(events_.size()) {
  for (const PayloadEvent& event : events_) {
    SCORIA_DEMAND(event.Problem().empty(), "payload event: {}", event.Problem());
  }
}

std::vector<TrunkChange> PayloadRack::Update(const core::EventClock& now) {
  const double time_s = now.time_s;
  announcements_.clear();
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const PayloadEvent& e = events_[i];
    const bool begins =
        e.at_s ? timers_[i].BeginAfter(*e.at_s, now) : timers_[i].BeginBeyond(*e.distance_m, now);
    if (begins) announcements_.push_back(Begin(e, *timers_[i].begun_s()));
  }
  std::vector<TrunkChange> changes;
  for (const AttachVelocity velocity : {AttachVelocity::kMatched, AttachVelocity::kRest}) {
    for (Item& item : items_) {
      if (item.attach_velocity == velocity) item.now = item.At(time_s);
    }
    const SpatialInertia trunk = Compose();
    if (trunk == trunk_) continue;
    trunk_ = trunk;
    changes.push_back({trunk, velocity});
  }
  std::erase_if(items_, [&](const Item& item) { return item.IsGone(time_s); });
  return changes;
}

std::optional<TrunkChange> PayloadRack::RemoveAll() {
  events_.clear();
  timers_.clear();
  items_.clear();
  if (trunk_ == bare_trunk_) return std::nullopt;
  trunk_ = bare_trunk_;
  return TrunkChange{bare_trunk_, AttachVelocity::kMatched};
}

/// @returns the announcement.
std::string PayloadRack::Begin(const PayloadEvent& event, double begin_s) {
  const Ramp ramp{begin_s, event.duration_s};
  const auto item = std::find_if(items_.begin(), items_.end(), [&](const Item& i) {
    return i.body.name == event.name() && i.share_to > 0.0;
  });
  if (event.action == PayloadAction::kAdd) {
    if (item != items_.end())
      return fmt::format("payload {} not added: it is on the trunk", event.name());
    return Add(event, ramp);
  }
  if (item == items_.end()) {
    return fmt::format("payload {}: nothing to {}, it is not on the trunk", event.name(),
                       core::EnumName(event.action));
  }
  return event.action == PayloadAction::kMove ? Move(event, ramp, *item) : Lose(event, ramp, *item);
}

std::string PayloadRack::Add(const PayloadEvent& event, const Ramp& ramp) {
  Item item;
  item.body = *event.body;
  item.whole = item.now = ToInertia(item.body);
  item.now.mass_kg = 0.0;
  item.now.I_C = Mat3::Zero();
  item.share_ramp = ramp;
  item.p_BP_from = item.p_BP_to = item.body.p_BP_m;
  item.attach_velocity = event.attach_velocity;
  items_.push_back(item);
  return fmt::format("payload {} added{}: {:g} kg at {}{}", item.body.name, Over(event.duration_s),
                     item.body.mass_kg, Text(item.body.p_BP_m),
                     event.attach_velocity == AttachVelocity::kRest ? ", from rest" : "");
}

std::string PayloadRack::Move(const PayloadEvent& event, const Ramp& ramp, Item& item) {
  item.p_BP_from = item.PositionAt(ramp.begin_s);
  item.q_from = item.TurnAt(ramp.begin_s);
  item.pose_ramp = ramp;
  item.p_BP_to = event.p_BP_m.value_or(item.p_BP_from);
  item.q_to = item.q_from;
  if (event.rpy_rad) {
    // `whole` holds the inertia as it was added: turns are from there.
    item.q_to = Quat(core::RotationFromRpy(*event.rpy_rad) *
                     core::RotationFromRpy(item.body.rpy_rad).transpose());
  }
  if (item.now.mass_kg == item.whole.mass_kg) item.attach_velocity = AttachVelocity::kMatched;
  return fmt::format("payload {} moved{}: {:g} kg to {}", item.body.name, Over(event.duration_s),
                     item.ShareAt(ramp.begin_s) * item.whole.mass_kg, Text(item.p_BP_to));
}

std::string PayloadRack::Lose(const PayloadEvent& event, const Ramp& ramp, Item& item) {
  item.share_from = item.ShareAt(ramp.begin_s);
  item.share_to =
      event.action == PayloadAction::kShed ? (1.0 - event.share) * item.share_from : 0.0;
  item.share_ramp = ramp;
  item.attach_velocity = AttachVelocity::kMatched;
  const double before_kg = item.share_from * item.whole.mass_kg;
  const std::string place = Text(item.PositionAt(ramp.begin_s));
  if (event.action == PayloadAction::kRemove) {
    return fmt::format("payload {} removed{}: {:g} kg at {}", item.body.name,
                       Over(event.duration_s), before_kg, place);
  }
  return fmt::format("payload {} loses a part{}: {:g} of {:g} kg at {}", item.body.name,
                     Over(event.duration_s), event.share * before_kg, before_kg, place);
}

SpatialInertia PayloadRack::Compose() const {
  std::vector<SpatialInertia> bodies;
  for (const Item& item : items_) bodies.push_back(item.now);
  return AddBodies(bare_trunk_, bodies);
}

}  // namespace scoria::sim
