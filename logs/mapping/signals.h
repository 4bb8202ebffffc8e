// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace scoria::logs {

/// Everything that a mapping can give to rows.
enum class SignalId {
  kJointQ,
  kJointQd,
  kJointTau,
  kImuAttitude,
  kImuRate,
  kImuAcceleration,
  kFootForce,
  kBatteryVoltage,
  kBatteryCurrent,
  kJointCommandQ,
  kJointCommandQd,
  kJointCommandTau,
  kJointCommandKp,
  kJointCommandKd,
  kEstimatePosition,
  kEstimateVelocity,
  kEstimateAttitude,
  kTruthPosition,
  kTruthVelocity,
  kTruthRate,
  kTruthAttitude,
  kTrueContact,
  kTrueForce,
  kTrueFootPosition,
  kCommandVx,
  kCommandVy,
  kCommandWz,
  kPlanPeriod,
  kPlanDuty,
  kPlanPhase,
  kPlanStance,
  kPlanFootTarget,
  kReferencePosition,
  kReferenceVelocity,
  kReferenceAttitude,
  kContact,
  kContactForce,
  kModelMass,
  kModelCom,
  kMpcTime,
  kWbcTime,
};
inline constexpr std::size_t kNumSignals = 41;

/// What a signal is made of.
enum class SignalShape { kScalar, kVector, kAttitude, kPerLeg, kPerJoint, kVectorPerLeg };

/// How a signal of one topic goes into a row between two messages.
enum class SignalJoining {
  kInterpolate,
  kHold,   // the last one
  kEvent,  // in the first row at or after its message, and no other
};

struct SignalTraits {
  SignalId id;
  std::string_view key;  // in the mapping file: "joints.q"
  SignalShape shape;
  SignalJoining joining;
};

/// By SignalId.
[[nodiscard]] const std::array<SignalTraits, kNumSignals>& AllSignals() noexcept;
[[nodiscard]] inline const SignalTraits& TraitsOf(SignalId id) noexcept {
  return AllSignals()[static_cast<std::size_t>(id)];
}

/// Numbers of a shape: an attitude is a quaternion w, x, y, z.
[[nodiscard]] constexpr std::size_t SizeOf(SignalShape shape) noexcept {
  constexpr std::array<std::size_t, 6> kSizes = {1, 3, 4, 4, 12, 12};
  return kSizes[static_cast<std::size_t>(shape)];
}

/// The numbers of a signal in SI, legs FL FR HL HR, joints HAA HFE KFE; the first SizeOf count.
using SignalValues = std::array<double, 12>;

/// By SignalId; absent where a message or row has none.
template <class T>
using PerSignal = std::array<std::optional<T>, kNumSignals>;
using SignalSet = PerSignal<SignalValues>;

}  // namespace scoria::logs
