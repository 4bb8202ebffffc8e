// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/velocity_smoother.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/LU>

namespace scoria::analysis {
namespace {

constexpr double kHold_mps = 0.01;  // scatter of what a foot tells that holds
constexpr double kFreedom = 1.0;    // of Student's distribution: Cauchy's
constexpr double kWalk = 0.015;     // m/s / √s, of the integrated accelerometer
constexpr double kFreeWalk = 1.0;   // m/s / √s, of the velocity without one
constexpr double kBias_mps2 = 0.3;  // at first: the accelerometer's and the attitude's error
constexpr double kBiasWalk = 0.02;  // m/s² / √s
constexpr double kFirst_mps = 3.0;  // velocities at first
/// Times kHold_mps, iteration by iteration: feet that slip must not decide which feet slip.
constexpr std::array<double, 12> kWiden = {32, 16, 8, 4, 2, 1, 1, 1, 1, 1, 1, 1};

/// Velocity and the accelerometer's bias. Their covariance is alike along all axes.
struct Moment {
  Vec3 v_WS = Vec3::Zero(), b_W = Vec3::Zero();
  Eigen::Matrix2d P = Eigen::Vector2d(kFirst_mps * kFirst_mps, kBias_mps2* kBias_mps2).asDiagonal();
};

using Weights = LegArray<double>;

/// ∂[v, b] / ∂[v, b] before.
Eigen::Matrix2d Transition(double dt_s, bool has_acceleration) {
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  if (has_acceleration) F(0, 1) = -dt_s;
  return F;
}

/// The acceleration between two clues.
std::optional<Vec3> MeanAcceleration(const VelocityClue& before, const VelocityClue& after) {
  if (!before.a_WS || !after.a_WS) return std::nullopt;
  return Vec3(0.5 * (*before.a_WS + *after.a_WS));
}

Moment Predict(Moment m, const VelocityClue& before, const VelocityClue& after) {
  const double dt_s = after.time_s - before.time_s;
  const std::optional<Vec3> a_WS = MeanAcceleration(before, after);
  if (a_WS) m.v_WS += dt_s * (*a_WS - m.b_W);
  const Eigen::Matrix2d F = Transition(dt_s, a_WS.has_value());
  const double walk = a_WS ? kWalk : kFreeWalk;
  m.P = F * m.P * F.transpose();
  m.P.diagonal() += dt_s * Eigen::Vector2d(walk * walk, kBiasWalk * kBiasWalk);
  return m;
}

void Correct(const VelocityClue& clue, const Weights& weights, double hold_mps, Moment& m) {
  double sum = 0.0;
  Vec3 weighted = Vec3::Zero();
  for (const Leg leg : kLegs) {
    if (!clue.v_WS[leg]) continue;
    sum += weights[leg];
    weighted += weights[leg] * *clue.v_WS[leg];
  }
  if (sum <= 0.0) return;
  const Eigen::Vector2d gain = m.P.col(0) / (m.P(0, 0) + hold_mps * hold_mps / sum);
  const Vec3 residual = weighted / sum - m.v_WS;
  m.v_WS += gain[0] * residual;
  m.b_W += gain[1] * residual;
  const Eigen::RowVector2d told = m.P.row(0);
  m.P -= gain * told;
}

/// Forwards, then backwards over what that leaves.
void Smooth(std::span<const VelocityClue> clues, const std::vector<Weights>& weights,
            double hold_mps, std::vector<Moment>& predicted, std::vector<Moment>& moments) {
  for (std::size_t i = 0; i < clues.size(); ++i) {
    predicted[i] = i == 0 ? Moment{} : Predict(moments[i - 1], clues[i - 1], clues[i]);
    moments[i] = predicted[i];
    Correct(clues[i], weights[i], hold_mps, moments[i]);
  }
  for (std::size_t i = clues.size() - 1; i-- > 0;) {
    const Moment& after = predicted[i + 1];
    const Eigen::Matrix2d F = Transition(clues[i + 1].time_s - clues[i].time_s,
                                         MeanAcceleration(clues[i], clues[i + 1]).has_value());
    const Eigen::Matrix2d gain = moments[i].P * F.transpose() * after.P.inverse();
    const Vec3 dv = moments[i + 1].v_WS - after.v_WS, db = moments[i + 1].b_W - after.b_W;
    moments[i].v_WS += gain(0, 0) * dv + gain(0, 1) * db;
    moments[i].b_W += gain(1, 0) * dv + gain(1, 1) * db;
  }
}

Weights WeightsAt(const VelocityClue& clue, const Vec3& v_WS, double hold_mps) {
  constexpr double kDimensions = 3.0;
  Weights weights(0.0);
  for (const Leg leg : kLegs) {
    if (!clue.v_WS[leg]) continue;
    const double squared = (*clue.v_WS[leg] - v_WS).squaredNorm() / (hold_mps * hold_mps);
    weights[leg] = (kFreedom + kDimensions) / (kFreedom + squared);
  }
  return weights;
}

}  // namespace

std::vector<Vec3> SmoothVelocity(std::span<const VelocityClue> clues) {
  if (clues.empty()) return {};
  std::vector<Weights> weights(clues.size(), Weights(1.0));
  std::vector<Moment> predicted(clues.size()), moments(clues.size());
  for (const double widen : kWiden) {
    Smooth(clues, weights, widen * kHold_mps, predicted, moments);
    for (std::size_t i = 0; i < clues.size(); ++i)
      weights[i] = WeightsAt(clues[i], moments[i].v_WS, widen * kHold_mps);
  }
  std::vector<Vec3> v_WS(clues.size());
  std::transform(moments.begin(), moments.end(), v_WS.begin(),
                 [](const Moment& m) { return m.v_WS; });
  return v_WS;
}

void VelocitySmoother::Add(const VelocityClue& clue) {
  clues_.push_back(clue);
  if (clue.time_s - clues_[given_].time_s < kBlock_s + kOverlap_s) return;
  const auto at = [this](double time_s) {
    const auto is_before = [](const VelocityClue& c, double t) { return c.time_s < t; };
    return std::lower_bound(clues_.begin(), clues_.end(), time_s, is_before);
  };
  GiveOut(static_cast<std::size_t>(at(clue.time_s - kOverlap_s) - clues_.begin()));
  const auto first = at(clues_[given_].time_s - kOverlap_s);
  given_ -= static_cast<std::size_t>(first - clues_.begin());
  clues_.erase(clues_.begin(), first);
}

void VelocitySmoother::Finish() {
  GiveOut(clues_.size());
  clues_.clear();
  given_ = 0;
}

void VelocitySmoother::GiveOut(std::size_t end) {
  const std::vector<Vec3> v_WS = SmoothVelocity(clues_);
  const auto from = [&](std::size_t k) { return v_WS.begin() + static_cast<std::ptrdiff_t>(k); };
  ready_.insert(ready_.end(), from(given_), from(end));
  given_ = end;
}

std::vector<Vec3> VelocitySmoother::Take() { return std::exchange(ready_, {}); }

}  // namespace scoria::analysis
