// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/joint_hypotheses.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

constexpr std::array<const char*, kJointsPerLeg> kNames = {"HAA", "HFE", "KFE"};

Vec3 Taken(const Vec3& v, const std::array<int, 3>& from) {
  return {v[from[0]], v[from[1]], v[from[2]]};
}

std::vector<JointHypothesis> MakeHypotheses() {
  std::vector<JointHypothesis> all(1);
  for (int j = 0; j < kJointsPerLeg; ++j) {
    const auto joint = static_cast<Joint>(j);
    JointHypothesis sign{.kind = FindingKind::kJointSign, .joint = joint};
    sign.sign[j] = -1.0;
    all.push_back(sign);
    JointHypothesis torque{.kind = FindingKind::kTorqueSign, .joint = joint};
    torque.torque_sign[j] = -1.0;
    all.push_back(torque);
    // Half a turn once: both ways it is the same.
    for (const double quarters : {1.0, -1.0, 2.0}) {
      JointHypothesis offset{.kind = FindingKind::kJointOffset, .joint = joint};
      offset.offset_rad[j] = quarters * 0.5 * std::numbers::pi;
      all.push_back(offset);
    }
  }
  // An axis y that points to the right turns both pitch joints.
  const Vec3 mirrored(1.0, -1.0, -1.0);
  all.push_back({.kind = FindingKind::kJointSign, .sign = mirrored});
  for (const double quarters : {1.0, -1.0, 2.0}) {
    JointHypothesis both{.kind = FindingKind::kJointOffset, .joint = Joint::kHFE, .sign = mirrored};
    both.offset_rad[1] = quarters * 0.5 * std::numbers::pi;
    all.push_back(both);
  }
  for (const std::array<int, 3>& from :
       {std::array{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}})
    all.push_back({.kind = FindingKind::kJointOrder, .from = from});
  return all;
}

}  // namespace

Vec3 JointHypothesis::UndoAngle(const Vec3& q) const {
  return sign.cwiseProduct(Taken(q, from)) - offset_rad;
}
Vec3 JointHypothesis::UndoRate(const Vec3& qd) const { return sign.cwiseProduct(Taken(qd, from)); }
Vec3 JointHypothesis::UndoTorque(const Vec3& tau) const {
  return sign.cwiseProduct(torque_sign).cwiseProduct(Taken(tau, from));
}

std::string JointHypothesis::Describe() const {
  switch (kind) {
    case FindingKind::kJointSign:
      return joint ? "the other sign of angle, rate and torque" : "the other signs of HFE and KFE";
    case FindingKind::kTorqueSign:
      return "the other sign of the torque";
    case FindingKind::kJointOffset:
      return fmt::format("{:+.4f} rad less{}", offset_rad[static_cast<int>(*joint)],
                         sign == Vec3::Ones() ? "" : " and the other signs of HFE and KFE");
    case FindingKind::kJointOrder:
      return fmt::format("HAA, HFE, KFE from the columns of {}, {}, {}",
                         kNames[std::size_t(from[0])], kNames[std::size_t(from[1])],
                         kNames[std::size_t(from[2])]);
    default:
      return "as it is";
  }
}

std::string JointHypothesis::Repair() const {
  switch (kind) {
    case FindingKind::kJointSign:
      return joint ? "mapping: joints.sign: -1 for this joint"
                   : "mapping: joints.sign: [1, -1, -1] for this leg";
    case FindingKind::kTorqueSign:
      return "mapping: joints.tau: {scale: -1} if all joints are so";
    case FindingKind::kJointOffset:
      return fmt::format("mapping: joints.zero_rad: {:+.4f} for this joint{}",
                         -offset_rad[static_cast<int>(*joint)],
                         sign == Vec3::Ones() ? "" : ", joints.sign: [1, -1, -1]");
    case FindingKind::kJointOrder:
      return "mapping: joints.names in the order of the columns";
    default:
      return "";
  }
}

const std::vector<JointHypothesis>& JointHypotheses() {
  static const std::vector<JointHypothesis> kAll = MakeHypotheses();
  return kAll;
}

}  // namespace scoria::logs
