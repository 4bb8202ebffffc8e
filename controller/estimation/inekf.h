// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/math/types.h"
#include "core/robot/legs.h"

namespace scoria::controller {

/// Covariance densities of the continuous white noises, all in S: the square of the usual
/// "per √Hz" numbers. A sample held for dt carries density / dt.
struct InekfNoise {
  Mat3 gyro = Mat3::Zero();        // (rad/s)²/Hz
  Mat3 accel = Mat3::Zero();       // (m/s²)²/Hz
  Mat3 gyro_bias = Mat3::Zero();   // (rad/s²)²/Hz, random walk
  Mat3 accel_bias = Mat3::Zero();  // (m/s³)²/Hz, random walk
  Mat3 contact = Mat3::Zero();     // (m/s)²/Hz, creep of a foot that stands
  bool operator==(const InekfNoise&) const = default;
};

enum class InekfModel {
  kExact,         // mean and transition exact for angular rate and force constant in S
  kHeldRotation,  // for comparison only: R held over a step, Φ = I + A dt, and a new foot placed
                  // with the attitude from before the correction
};

struct InekfParams {
  InekfNoise noise{};
  Vec3 gravity_W = Vec3(0.0, 0.0, -9.81);  // m/s²
  InekfModel model = InekfModel::kExact;
};

/// Mean of the filter. S is the IMU, F the foot of the leg.
struct InekfState {
  Mat3 R_WS = Mat3::Identity();
  Vec3 v_WS = Vec3::Zero(), p_WS = Vec3::Zero();
  Vec3 gyro_bias_S = Vec3::Zero(), accel_bias_S = Vec3::Zero();  // measured = true + bias
  LegArray<Vec3> p_WF = ZeroPerLeg();                            // where `in_state`, else zero
  LegArray<bool> in_state{false};  // feet whose place is part of the state
  bool operator==(const InekfState&) const = default;
};

/// Layout of the error vector ξ: right-invariant, X̂ X⁻¹ = Exp(ξ), and bias errors b̂ − b.
struct InekfIndex {
  static constexpr int kRotation = 0, kVelocity = 3, kPosition = 6, kGyroBias = 9, kAccelBias = 12,
                       kFeet = 15, kDim = kFeet + 3 * kNumLegs;
  [[nodiscard]] static constexpr int Foot(Leg leg) noexcept {
    return kFeet + 3 * static_cast<int>(leg);
  }
};

/// A foot that is not in the state has rows and columns of zeros.
using InekfCovariance = Eigen::Matrix<double, InekfIndex::kDim, InekfIndex::kDim>;

/// What leg kinematics tell of one foot.
struct FootMeasurement {
  bool in_contact = false;
  Vec3 p_SF_S = Vec3::Zero();    // m
  Mat3 cov_SF_S = Mat3::Zero();  // m², of p_SF_S
  bool operator==(const FootMeasurement&) const = default;
};

enum class InekfStatus { kOk, kNotFinite, kIndefinite };

/// y = R p_SF_S − (p_WF − p_WS) before the correction, and the covariance the filter expects of it.
struct FootInnovation {
  bool used = false;  // in contact and in the state
  Vec3 y_W = Vec3::Zero();
  Mat3 cov_W = Mat3::Zero();
  bool operator==(const FootInnovation&) const = default;
};

struct InekfCorrection {
  InekfStatus status = InekfStatus::kOk;
  double nis = 0.0;  // yᵀ S⁻¹ y of all feet used, χ² distributed with
  int dof = 0;       // so many degrees of freedom; both 0 without such a foot or when refused
  LegArray<FootInnovation> feet{};
};

/// Contact-aided right-invariant extended Kalman filter: attitude, velocity, position, IMU biases
/// and the places of standing feet, from an IMU and leg kinematics.
///   R⁺ = R Γ_0,  v⁺ = v + g dt + R Γ_1 a dt,  p⁺ = p + v dt + ½ g dt² + R Γ_2 a dt²
/// with Γ_m of (ω dt), ω and a free of bias; P⁺ = Φ (P + Ad Q Adᵀ dt) Φᵀ.
/// Yaw and position are not observable: their covariance grows.
/// Errors:  what cannot be done is refused and told by the status; the state stays finite.
/// Source:  [Hartley2020]; differs: Φ in a closed form without a division by the angular rate (see
///          CalcExactTransition).
class Inekf {
 public:
  /// At the origin, at rest, level, with zero covariance and no foot in the state.
  explicit Inekf(const InekfParams& params) noexcept : params_(params) {}

  /// Replaces mean and covariance; only the lower triangle of `P` is read, and nothing of feet that
  /// are not in the state.
  /// @pre `P` positive semidefinite, R_WS a rotation, all finite.
  void Set(const InekfState& state, const InekfCovariance& P) noexcept;
  void set_noise(const InekfNoise& noise) noexcept { params_.noise = noise; }

  /// Moves on by `dt_s` >= 0 with an IMU sample held over it.
  /// @param a_S specific force, m/s² (+g at rest).   @param w_S angular rate, rad/s.
  /// @returns kNotFinite, and changes nothing, for numbers that are not finite or a negative time.
  [[nodiscard]] InekfStatus Predict(const Vec3& a_S, const Vec3& w_S, double dt_s) noexcept;

  /// One correction with all feet that are in contact and in the state; then feet out of contact
  /// leave the state and new ones enter it.
  /// Refused with kNotFinite (a foot in contact, or the outcome) or kIndefinite (covariance of the
  /// innovation): then no foot enters, those out of contact leave all the same.
  [[nodiscard]] InekfCorrection Correct(const LegArray<FootMeasurement>& feet) noexcept;

  /// What Correct would compare for this foot, e.g. to leave out one that slips.
  [[nodiscard]] FootInnovation CalcInnovation(Leg leg, const FootMeasurement& foot) const noexcept;

  /// Takes the foot out of the state.
  void Drop(Leg leg) noexcept;

  /// Moves the foot's place by a displacement known in S (δ_W = R δ_S, e.g. of a sphere that rolls
  /// as its leg turns), with the covariance `cov_W` of the displacement on top. The right-invariant
  /// error is not touched by it. No effect on a foot that is not in the state.
  void MoveFoot(Leg leg, const Vec3& delta_W, const Mat3& cov_W = Mat3::Zero()) noexcept;

  [[nodiscard]] const InekfState& state() const noexcept { return x_; }
  [[nodiscard]] const InekfCovariance& covariance() const noexcept { return P_; }
  [[nodiscard]] const InekfNoise& noise() const noexcept { return params_.noise; }

 private:
  /// The feet of one stacked correction.
  struct Stack {
    std::array<Leg, kNumLegs> legs{};
    int size = 0;
  };
  [[nodiscard]] InekfStatus CorrectStack(const Stack& stack, InekfCorrection& result) noexcept;
  template <int n>
  [[nodiscard]] InekfStatus CorrectWith(const Stack& stack, InekfCorrection& result) noexcept;
  void Retract(const Eigen::Matrix<double, InekfIndex::kDim, 1>& xi) noexcept;
  void Append(Leg leg, const FootMeasurement& foot, const Mat3& R_WS) noexcept;

  InekfParams params_;
  InekfState x_;
  InekfCovariance P_ = InekfCovariance::Zero();
};

/// The blocks of the error's transition Φ = I + … over one step that are not zero; rows are named
/// first. Needed by Predict; public to be tested.
struct InekfTransition {
  Mat3 rotation_gyro_bias = Mat3::Zero();
  Mat3 velocity_rotation = Mat3::Zero();
  Mat3 velocity_gyro_bias = Mat3::Zero();
  Mat3 velocity_accel_bias = Mat3::Zero();
  Mat3 position_rotation = Mat3::Zero();
  double position_velocity = 0.0;  // times the identity
  Mat3 position_gyro_bias = Mat3::Zero();
  Mat3 position_accel_bias = Mat3::Zero();
  LegArray<Mat3> foot_gyro_bias{Mat3::Zero()};  // zero where the foot is not in the state
};

/// Φ of ξ̇ = A(t) ξ along the exact mean. With φ = ω dt, Γ_m = Γ_m(φ):
///
///   Φ_v,bg = −[v + g dt]× R Γ_1 dt − R Ψ_1 dt²
///
///   Φ_p,bg = −[p + v dt + ½ g dt²]× R Γ_1 dt − R Ψ_2 dt³
///
///   Ψ_1 = Σ_ij φ×ⁱ a× φ×ʲ / (i+j+2)! = a× Γ_2 + Γ_2 a× − ½ a× − (φ·a) (Γ_2 − 3 Γ_3)
///
///   Ψ_2 = Σ_ij (j+2) φ×ⁱ a× φ×ʲ / (i+j+3)!
///       = a× (Γ_2 − Γ_3) + 2 Γ_3 a× − ⅓ a× − ½ (φ·a) (Γ_2 − 2 Γ_3 − 4 Γ_4)
///
/// by φ× a× φ× = −(φ·a) φ×: nothing is divided by |φ|, so it is exact at rest, too.
/// @param a_S, w_S free of bias.
[[nodiscard]] InekfTransition CalcExactTransition(const InekfState& x, const Vec3& gravity_W,
                                                  const Vec3& a_S, const Vec3& w_S,
                                                  double dt_s) noexcept;

}  // namespace scoria::controller
