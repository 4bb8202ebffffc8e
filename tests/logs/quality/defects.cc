// SPDX-License-Identifier: BSD-3-Clause
#include "tests/logs/quality/defects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/math/angles.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "logs/quality/tick.h"
#include "logs/vectors.h"

namespace scoria::test {
namespace {

using logs::Array12;
using logs::Array3;
using logs::FindingKind;
using logs::Row;
using Rows = std::vector<Row>;
using Result = std::optional<Expected>;

constexpr double kGravity_mps2 = 9.81;

/// Calls change(values) with the angles, rates and torques of the joints of every row.
template <class Change>
void ChangeJoints(Rows& rows, const Change& change) {
  for (Row& row : rows) {
    for (auto* values : {&row.measured->q_rad, &row.measured->qd_radps, &row.measured->tau_Nm}) {
      if (*values) change(**values);
    }
  }
}

template <class Change>
void ChangeAttitudes(Rows& rows, const Change& change) {
  for (Row& row : rows) {
    if (row.estimate) row.estimate->rpy_rad = change(row.estimate->rpy_rad);
    if (row.truth) row.truth->rpy_rad = change(row.truth->rpy_rad);
  }
}

std::string AttitudeSignal(const Rows& rows) {
  return rows.front().truth ? "truth.attitude" : "estimate.attitude";
}

struct Place {
  std::size_t number = 0;  // of twelve
  [[nodiscard]] Leg leg() const { return kLegs[number / 3]; }
  [[nodiscard]] Joint joint() const { return static_cast<Joint>(number % 3); }
};
/// Ten of the twelve joints: all legs, all joints.
Place JointOf(int place) { return {static_cast<std::size_t>(place) * 5 % 12}; }

/// A moment within the rows, earlier or later by place, that leaves `after_s` behind it.
double MomentOf(const Rows& rows, int place, double after_s) {
  const double begin = rows.front().time_s, end = rows.back().time_s - after_s - 0.3;
  return begin + 0.5 + (end - begin - 0.5) * place / 9.0;
}

Result SwapLegs(Rows& rows, const std::array<std::size_t, 4>& from, const std::string& words) {
  ChangeJoints(rows, [&](Array12& values) {
    const Array12 old = values;
    for (std::size_t leg = 0; leg < 4; ++leg)
      std::copy_n(old.begin() + static_cast<long>(3 * from[leg]), 3,
                  values.begin() + static_cast<long>(3 * leg));
  });
  for (Row& row : rows) {
    auto& feet = row.measured->foot_force_counts;
    if (!feet) continue;
    const auto old = *feet;
    for (std::size_t leg = 0; leg < 4; ++leg) (*feet)[leg] = old[from[leg]];
  }
  return Expected{.kind = FindingKind::kLegOrder, .words = words};
}

Result JointSign(Rows& rows, int place) {
  const Place at = JointOf(place);
  ChangeJoints(rows, [&](Array12& values) { values[at.number] = -values[at.number]; });
  return Expected{.kind = FindingKind::kJointSign, .leg = at.leg(), .joint = at.joint()};
}

Result JointOrder(Rows& rows, int place) {
  constexpr std::array<std::array<std::size_t, 3>, 5> kFrom = {
      {{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}};
  const std::size_t leg = static_cast<std::size_t>(place) % 4;
  const auto& from = kFrom[static_cast<std::size_t>(place) % 5];
  ChangeJoints(rows, [&](Array12& values) {
    const Array12 old = values;
    for (std::size_t j = 0; j < 3; ++j) values[3 * leg + j] = old[3 * leg + from[j]];
  });
  return Expected{.kind = FindingKind::kJointOrder, .leg = kLegs[leg]};
}

Result Degrees(Rows& rows, int place) {
  const auto scale = [](auto& values) {
    for (double& value : values) value *= core::kDegreesPerRad;
  };
  Expected expected{.kind = FindingKind::kDegrees};
  switch (place % 4) {
    case 0:
      for (Row& row : rows) scale(*row.measured->q_rad), scale(*row.measured->qd_radps);
      expected.signal = "joints.q";
      return expected;
    case 1:
      for (Row& row : rows) scale(*row.measured->qd_radps);
      expected.signal = "joints.qd";
      return expected;
    case 2:
      expected.signal = rows.front().measured->w_WS_S_radps ? "imu.rate" : "truth.rate";
      for (Row& row : rows)
        scale(row.measured->w_WS_S_radps ? *row.measured->w_WS_S_radps : row.truth->w_WB_radps);
      return expected;
    default:
      ChangeAttitudes(rows, [&](Array3 rpy) {
        scale(rpy);
        return rpy;
      });
      expected.signal = AttitudeSignal(rows);
      return expected;
  }
}

Result Millimetres(Rows& rows, int) {
  for (Row& row : rows) {
    for (double& p : row.truth ? row.truth->p_WB_m : row.estimate->p_WB_m) p *= 1e3;
  }
  return Expected{.kind = FindingKind::kMillimetres,
                  .signal = rows.front().truth ? "truth.position" : "estimate.position"};
}

template <class Change>
Result ChangeAcceleration(Rows& rows, FindingKind kind, const Change& change,
                          const std::string& words = "") {
  if (!rows.front().measured->a_WS_S_mps2) return std::nullopt;
  for (Row& row : rows) change(row, *row.measured->a_WS_S_mps2);
  return Expected{.kind = kind, .signal = "imu.acceleration", .words = words};
}

Result InG(Rows& rows, int) {
  return ChangeAcceleration(rows, FindingKind::kGravityUnit, [](const Row&, Array3& a) {
    for (double& value : a) value /= kGravity_mps2;
  });
}

Result WithoutGravity(Rows& rows, int) {
  return ChangeAcceleration(rows, FindingKind::kGravityMissing, [](const Row& row, Array3& a) {
    const Mat3 R_WB =
        core::RotationFromRpy(logs::ToVec3(row.truth ? row.truth->rpy_rad : row.estimate->rpy_rad));
    a = logs::ToArray(logs::ToVec3(a) - R_WB.transpose() * Vec3(0.0, 0.0, kGravity_mps2));
  });
}

Result FlippedZ(Rows& rows, int) {
  return ChangeAcceleration(
      rows, FindingKind::kGravitySign, [](const Row&, Array3& a) { a[2] = -a[2]; }, "-z");
}

Result QuaternionOrder(Rows& rows, int place) {
  const bool scalar_first = place % 2 == 0;
  ChangeAttitudes(rows, [&](const Array3& rpy) {
    const Quat q(core::RotationFromRpy(logs::ToVec3(rpy)));
    const Quat wrong = scalar_first ? Quat(q.z(), q.w(), q.x(), q.y())   // w x y z as x y z w
                                    : Quat(q.x(), q.y(), q.z(), q.w());  // x y z w as w x y z
    return logs::ToArray(core::RpyFromRotation(wrong.toRotationMatrix()));
  });
  return Expected{.kind = FindingKind::kQuaternionOrder,
                  .signal = AttitudeSignal(rows),
                  .words = scalar_first ? "wxyz" : "xyzw"};
}

Result RollPitchSwapped(Rows& rows, int) {
  ChangeAttitudes(rows, [](const Array3& rpy) { return Array3{rpy[1], rpy[0], rpy[2]}; });
  return Expected{.kind = FindingKind::kRollPitchSwapped, .signal = AttitudeSignal(rows)};
}

Result JointOffset(Rows& rows, int place) {
  const Place at = JointOf(place);
  const double offset_rad = (place % 2 == 0 ? 0.5 : -0.5) * std::numbers::pi;
  for (Row& row : rows) (*row.measured->q_rad)[at.number] += offset_rad;
  return Expected{.kind = FindingKind::kJointOffset,
                  .leg = at.leg(),
                  .joint = at.joint(),
                  .size = offset_rad,
                  .size_within = 0.01};
}

Result RepeatedTenTimes(Rows& rows, int place) {
  const std::size_t phase = static_cast<std::size_t>(place);
  const double rate_Hz =
      static_cast<double>(rows.size() - 1) / (rows.back().time_s - rows.front().time_s);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && (i + phase) % 10 != 0) rows[i].measured = rows[i - 1].measured;
  }
  return Expected{.kind = FindingKind::kRepeatedSamples,
                  .signal = "joints.q",
                  .size = rate_Hz / 10.0,
                  .size_within = rate_Hz / 100.0};
}

Result LostFivePercent(Rows& rows, int place) {
  core::Rng rng(static_cast<std::uint64_t>(place), 0, core::Stream::kSensor);
  Rows kept;
  for (const Row& row : rows) {
    if (rng.NextUniform(0.0, 1.0) >= 0.05) kept.push_back(row);
  }
  const double lost = 1.0 - static_cast<double>(kept.size()) / static_cast<double>(rows.size());
  rows = kept;
  return Expected{.kind = FindingKind::kLostSamples, .size = lost, .size_within = 0.005};
}

Result Gap(Rows& rows, int place) {
  const double begin_s = MomentOf(rows, place, 0.5);
  std::erase_if(rows,
                [&](const Row& row) { return row.time_s > begin_s && row.time_s < begin_s + 0.5; });
  return Expected{.kind = FindingKind::kGap,
                  .span = logs::TimeSpan{begin_s, begin_s + 0.5},
                  .size = 0.5,
                  .size_within = 0.02};
}

Result ClockStep(Rows& rows, int place) {
  const double at_s = MomentOf(rows, place, 0.0), step_s = place % 2 == 0 ? 1.0 : -1.0;
  for (Row& row : rows) {
    if (row.time_s > at_s) row.time_s += step_s;
  }
  return Expected{
      .kind = FindingKind::kClockStep,
      .span = logs::TimeSpan{std::min(at_s, at_s + step_s), std::max(at_s, at_s + step_s)},
      .size = step_s,
      .size_within = 0.01};
}

Result LateImu(Rows& rows, int) {
  if (!rows.front().measured->w_WS_S_radps) return std::nullopt;
  const Rows old = rows;
  std::size_t from = 0;
  for (Row& row : rows) {
    while (from + 1 < old.size() && old[from + 1].time_s <= row.time_s - 0.02) ++from;
    row.measured->w_WS_S_radps = old[from].measured->w_WS_S_radps;
    row.measured->a_WS_S_mps2 = old[from].measured->a_WS_S_mps2;
  }
  return Expected{.kind = FindingKind::kImuDelay, .size = 0.02, .size_within = 0.004};
}

Result StuckEncoder(Rows& rows, int place) {
  const Place at = JointOf(place);
  const double begin_s = MomentOf(rows, place, 2.0);
  std::optional<double> held;
  for (Row& row : rows) {
    if (row.time_s < begin_s || row.time_s > begin_s + 2.0) continue;
    if (!held) held = (*row.measured->q_rad)[at.number];
    (*row.measured->q_rad)[at.number] = *held;
    (*row.measured->qd_radps)[at.number] = 0.0;
  }
  return Expected{.kind = FindingKind::kStuckSensor,
                  .signal = "joints.q",
                  .leg = at.leg(),
                  .joint = at.joint(),
                  .span = logs::TimeSpan{begin_s, begin_s + 2.0}};
}

Result DeadFootSensor(Rows& rows, int place) {
  if (!rows.front().measured->foot_force_counts) return std::nullopt;
  const std::size_t leg = static_cast<std::size_t>(place) % 4;
  const double begin_s = place < 5 ? rows.front().time_s : MomentOf(rows, place - 5, 2.0);
  for (Row& row : rows) {
    if (row.time_s >= begin_s) (*row.measured->foot_force_counts)[leg] = place % 2 == 0 ? 0 : 25;
  }
  return Expected{.kind = FindingKind::kDeadSensor, .signal = "feet.force", .leg = kLegs[leg]};
}

Result TorqueGain(Rows& rows, int) {
  constexpr double kGain = 1.5;
  for (Row& row : rows) {
    for (double& tau : *row.measured->tau_Nm) tau *= kGain;
  }
  return Expected{.kind = FindingKind::kTorqueScale,
                  .signal = "joints.tau",
                  .size = kGain,
                  .size_within = 0.15 * kGain};
}

Result TorqueGainOfAJoint(Rows& rows, int place) {
  constexpr double kGain = 1.5;
  const Place at = JointOf(place);
  for (Row& row : rows) (*row.measured->tau_Nm)[at.number] *= kGain;
  return Expected{.kind = FindingKind::kTorqueScale,
                  .signal = "joints.tau",
                  .leg = at.leg(),
                  .joint = at.joint(),
                  .size = kGain,
                  .size_within = 0.15 * kGain};
}

}  // namespace

bool Names(const logs::Finding& f, const Expected& e) {
  const auto is_near = [](double a, double b) { return std::abs(a - b) < 0.1; };
  if (f.kind != e.kind || (!e.signal.empty() && f.signal != e.signal)) return false;
  if (f.leg != e.leg || f.joint != e.joint) return false;
  if (e.size && (!f.size || std::abs(*f.size - *e.size) > *e.size_within)) return false;
  if (e.span && std::none_of(f.spans.begin(), f.spans.end(), [&](const logs::TimeSpan& span) {
        return is_near(span.begin_s, e.span->begin_s) && is_near(span.end_s, e.span->end_s);
      }))
    return false;
  return (f.evidence + f.repair).find(e.words) != std::string::npos;
}

std::vector<Defect> Defects() {
  return {
      {"legs swapped front to hind", Needed::kNothing,
       [](Rows& rows, int) {
         return SwapLegs(rows, {2, 3, 0, 1}, "FL from HL, FR from HR, HL from FL, HR from FR");
       }},
      {"legs swapped left to right", Needed::kNothing,
       [](Rows& rows, int) {
         return SwapLegs(rows, {1, 0, 3, 2}, "FL from FR, FR from FL, HL from HR, HR from HL");
       }},
      {"a joint's sign", Needed::kNothing, JointSign},
      {"joint order in a leg", Needed::kNothing, JointOrder},
      {"degrees", Needed::kNothing, Degrees},
      {"millimetres", Needed::kNothing, Millimetres},
      {"acceleration in g", Needed::kImu, InG},
      {"acceleration without gravity", Needed::kImu, WithoutGravity},
      {"acceleration with z flipped", Needed::kImu, FlippedZ},
      {"quaternion order", Needed::kNothing, QuaternionOrder},
      {"roll and pitch swapped", Needed::kNothing, RollPitchSwapped},
      {"offset of pi/2 on a joint", Needed::kNothing, JointOffset},
      {"every sample ten times", Needed::kNothing, RepeatedTenTimes},
      {"5 % of samples lost", Needed::kNothing, LostFivePercent},
      {"gap of 0.5 s", Needed::kNothing, Gap},
      {"clock step of 1 s", Needed::kNothing, ClockStep},
      {"IMU 20 ms late", Needed::kImu, LateImu},
      {"encoder stuck for 2 s", Needed::kNothing, StuckEncoder},
      {"foot sensor dead", Needed::kFootForce, DeadFootSensor},
      {"torque gain 1.5", Needed::kNothing, TorqueGain},
      // Torques of HFE are small beside those of knees: their scale is told worse.
      {"torque gain 1.5 of a joint", Needed::kNothing, TorqueGainOfAJoint, 7},
  };
}

}  // namespace scoria::test
