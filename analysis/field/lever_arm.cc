// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/lever_arm.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/field/robust_fit.h"
#include "core/math/so3.h"

namespace scoria::analysis {
namespace {

constexpr std::size_t kImuHalf = 10, kEstimateHalf = 30;  // samples: h
constexpr std::size_t kEvery = 4, kBlock = 200;           // samples

/// x(t + h) - 2 x(t) + x(t - h).
template <class T, class Get>
T SecondDifference(std::size_t i, std::size_t h, const Get& get) {
  return get(i + h) - 2.0 * get(i) + get(i - h);
}

/// No trunk moves so fast from sample to sample: markers are mixed up there.
bool IsJump(const BodyPose& a, const BodyPose& b) {
  constexpr double kLargestSpeed_mps = 10.0, kLargestRate_radps = 20.0;
  return (b.p_WB - a.p_WB).norm() > kLargestSpeed_mps * MotionSamples::kStep_s ||
         core::LogSo3(a.R_WB.transpose() * b.R_WB).norm() >
             kLargestRate_radps * MotionSamples::kStep_s;
}

/// The truth at the time of each sample, its axes turned to those of the trunk; p_WB is p_WM.
struct TimedTruth {
  std::vector<std::optional<BodyPose>> poses;
  std::vector<std::size_t> runs;  // samples before each one without gap or jump

  [[nodiscard]] bool IsWhole(std::size_t i, std::size_t h) const {
    return poses[i + h] && runs[i + h] >= 2 * h;
  }
};

TimedTruth MakeTimedTruth(const std::vector<MotionSample>& samples, const TimeOffset& offset) {
  TimedTruth truth{std::vector<std::optional<BodyPose>>(samples.size()),
                   std::vector<std::size_t>(samples.size(), 0)};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    auto& pose = truth.poses[i];
    pose = TruthAt(samples, i, offset.delay_s);
    if (!pose) continue;
    pose->R_WB = pose->R_WB * offset.R_BM.transpose();
    const bool goes_on = i > 0 && truth.poses[i - 1] && !IsJump(*truth.poses[i - 1], *pose);
    if (goes_on) truth.runs[i] = truth.runs[i - 1] + 1;
  }
  return truth;
}

/// Place of the accelerometer and of a unit bias by integration twice, from 0 wherever the log
/// begins anew: second differences do not see from where.
struct Integrated {
  std::size_t run = 0;  // samples before this one without an interruption
  Vec3 p_W = Vec3::Zero(), v_W = Vec3::Zero(), a_W = Vec3::Zero();
  Mat3 P = Mat3::Zero(), V = Mat3::Zero(), R = Mat3::Zero();
};

std::vector<Integrated> Integrate(const std::vector<MotionSample>& samples, const TimedTruth& truth,
                                  double gravity_mps2) {
  std::vector<Integrated> out(samples.size());
  bool goes_on = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool is_there = samples[i].a_WS_B && truth.poses[i];
    if (is_there) {
      Integrated& now = out[i];
      now.R = truth.poses[i]->R_WB;
      now.a_W = now.R * *samples[i].a_WS_B - gravity_mps2 * Vec3::UnitZ();
      if (goes_on) {
        const Integrated& last = out[i - 1];
        const Vec3 a = 0.5 * (last.a_W + now.a_W);
        const Mat3 R = 0.5 * (last.R + now.R);
        now.run = last.run + 1;
        now.p_W = last.p_W + MotionSamples::kStep_s * last.v_W +
                  0.5 * MotionSamples::kStep_s * MotionSamples::kStep_s * a;
        now.v_W = last.v_W + MotionSamples::kStep_s * a;
        now.P = last.P + MotionSamples::kStep_s * last.V +
                0.5 * MotionSamples::kStep_s * MotionSamples::kStep_s * R;
        now.V = last.V + MotionSamples::kStep_s * R;
      }
    }
    goes_on = is_there;
  }
  return out;
}

/// Leaves out instants at which the trunk hardly turns: they tell no lever arm, and their small
/// errors would make those of others outliers.
template <int kSize>
std::vector<FitSample<kSize>> WithMotion(const std::vector<FitSample<kSize>>& samples) {
  constexpr double kQuantile = 0.9, kShare = 0.3;
  std::vector<double> turns;
  for (const FitSample<kSize>& s : samples) turns.push_back(s.X.template leftCols<3>().norm());
  if (turns.empty()) return {};
  std::vector<double> sorted = turns;
  const auto high =
      sorted.begin() + static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), high, sorted.end());
  std::vector<FitSample<kSize>> moving;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (turns[i] > kShare * *high) moving.push_back(samples[i]);
  }
  return moving;
}

std::optional<RobustFit<7>> FitByAccelerometer(const std::vector<MotionSample>& samples,
                                               const TimedTruth& truth, double gravity_mps2,
                                               std::size_t h) {
  const std::vector<Integrated> imu = Integrate(samples, truth, gravity_mps2);
  std::vector<FitSample<7>> fit;
  for (std::size_t i = h; i + h < samples.size(); i += kEvery) {
    if (imu[i + h].run < 2 * h || !truth.IsWhole(i, h)) continue;
    FitSample<7> s;
    s.X.leftCols<3>() =
        SecondDifference<Mat3>(i, h, [&](std::size_t k) { return truth.poses[k]->R_WB; });
    s.X.middleCols<3>(3) = -SecondDifference<Mat3>(i, h, [&](std::size_t k) { return imu[k].P; });
    s.X.col(6) = SecondDifference<Vec3>(i, h, [&](std::size_t k) { return imu[k].v_W; });
    s.y = SecondDifference<Vec3>(
        i, h, [&](std::size_t k) { return Vec3(truth.poses[k]->p_WB - imu[k].p_W); });
    s.block = i / kBlock;
    fit.push_back(s);
  }
  return FitRobustly(WithMotion(fit));
}

std::optional<RobustFit<4>> FitByEstimate(const std::vector<MotionSample>& samples,
                                          const TimedTruth& truth, std::size_t h) {
  const auto is_there = [&](std::size_t k) {
    return samples[k].estimate && samples[k - 1].estimate && samples[k + 1].estimate;
  };
  const auto place = [&](std::size_t k) { return samples[k].estimate->p_WB; };
  const auto velocity = [&](std::size_t k) {
    return Vec3((place(k + 1) - place(k - 1)) / (2.0 * MotionSamples::kStep_s));
  };
  std::vector<FitSample<4>> fit;
  for (std::size_t i = h + 1; i + h + 1 < samples.size(); i += kEvery) {
    if (!truth.IsWhole(i, h) || !is_there(i - h) || !is_there(i) || !is_there(i + h)) continue;
    const Mat3 R_error = truth.poses[i]->R_WB * samples[i].estimate->R_WB.transpose();
    const Mat3 R_yaw = core::RotationZ(core::RpyFromRotation(R_error).z());
    FitSample<4> s;
    s.X.leftCols<3>() =
        SecondDifference<Mat3>(i, h, [&](std::size_t k) { return truth.poses[k]->R_WB; });
    s.X.col(3) = R_yaw * SecondDifference<Vec3>(i, h, velocity);
    s.y = SecondDifference<Vec3>(i, h, [&](std::size_t k) { return truth.poses[k]->p_WB; }) -
          R_yaw * SecondDifference<Vec3>(i, h, place);
    s.block = i / kBlock;
    fit.push_back(s);
  }
  return FitRobustly(WithMotion(fit));
}

template <int kSize>
std::optional<LeverArm> ToLeverArm(const std::optional<RobustFit<kSize>>& fit,
                                   LeverArmSource source, const Vec3& p_origin) {
  if (!fit) return std::nullopt;
  return LeverArm{source, p_origin + fit->b.template head<3>(), fit->sigma().template head<3>()};
}

}  // namespace

std::optional<LeverArm> EstimateLeverArm(const std::vector<MotionSample>& samples,
                                         const TimeOffset& offset, LeverArmSource source,
                                         const Vec3& p_BS, double gravity_mps2) {
  const TimedTruth truth = MakeTimedTruth(samples, offset);
  const auto estimate_at = [&](int spans) {
    const auto factor = static_cast<std::size_t>(spans);
    if (source == LeverArmSource::kEstimate)
      return ToLeverArm(FitByEstimate(samples, truth, factor * kEstimateHalf), source,
                        Vec3::Zero());
    return ToLeverArm(FitByAccelerometer(samples, truth, gravity_mps2, factor * kImuHalf), source,
                      p_BS);
  };
  std::optional<LeverArm> arm = estimate_at(1);
  const std::optional<LeverArm> other = estimate_at(2);
  if (!arm || !other) return arm;
  for (Eigen::Index i = 0; i < 3; ++i)
    arm->sigma_m[i] = std::hypot(arm->sigma_m[i], 0.5 * (arm->p_BM[i] - other->p_BM[i]));
  return arm;
}

LeverArm Combine(const LeverArm& a, const LeverArm& b) noexcept {
  LeverArm out;
  out.source = LeverArmSource::kBoth;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double weight_a = 1.0 / (a.sigma_m[i] * a.sigma_m[i]),
                 weight_b = 1.0 / (b.sigma_m[i] * b.sigma_m[i]);
    out.p_BM[i] = (weight_a * a.p_BM[i] + weight_b * b.p_BM[i]) / (weight_a + weight_b);
    const double apart = std::abs(a.p_BM[i] - b.p_BM[i]) / std::hypot(a.sigma_m[i], b.sigma_m[i]);
    out.sigma_m[i] = std::max(1.0, apart) / std::sqrt(weight_a + weight_b);
  }
  return out;
}

}  // namespace scoria::analysis
