// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/velocity_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

constexpr std::size_t kMid = 10, kEnd = 20;
constexpr double kDriftSpan_s = 20.0 * kTick_s;

constexpr std::array kPositions = {SignalId::kImuAttitude, SignalId::kEstimatePosition,
                                   SignalId::kTruthPosition};  // the IMU tells none
constexpr std::array kVelocities = {SignalId::kImuAttitude, SignalId::kEstimateVelocity,
                                    SignalId::kTruthVelocity};

double RmsOf(const Moments& squares) { return std::sqrt(squares.mean()); }

bool IsAbout(double factor, double expected) {
  return factor > 0.7 * expected && factor < 1.4 * expected;
}

}  // namespace

void VelocityCheck::AddTick(const Tick& tick) {
  last_.Add(tick);
  if (!last_.IsFull()) return;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    if (last_[0].p_WB[s] && last_[kEnd].p_WB[s] && last_[kMid].v_WB[s]) AddCourse(s);
  }
}

void VelocityCheck::AddCourse(std::size_t source) {
  const Tick &begin = last_[0], &mid = last_[kMid], &end = last_[kEnd];
  Course& c = courses_[source];
  const Vec3 step = *last_[kMid + 1].p_WB[source] - *mid.p_WB[source];
  if (step.norm() > kLargestSpeed_mps * kTick_s) c.jumps.Add({mid.time_s, mid.time_s + kTick_s});
  const Vec3 slope = (*end.p_WB[source] - *begin.p_WB[source]) / kDriftSpan_s;
  if (!begin.v_WB[source] || !end.v_WB[source]) return;
  // Simpson's rule.
  const Vec3 v = (*begin.v_WB[source] + 4.0 * *mid.v_WB[source] + *end.v_WB[source]) / 6.0;
  c.slope_squares.Add(slope.squaredNorm());
  c.velocity_squares.Add(v.squaredNorm());
  if (!begin.R_WB[source] || !mid.R_WB[source] || !end.R_WB[source]) return;
  const Mat3& R_WB = *mid.R_WB[source];
  const Vec3 turned = (*begin.R_WB[source] * *begin.v_WB[source] +
                       4.0 * (R_WB * *mid.v_WB[source]) + *end.R_WB[source] * *end.v_WB[source]) /
                      6.0;
  const double size = 0.03 + 0.1 * v.norm(), cost = RobustCost((slope - v).squaredNorm(), size);
  c.cost.Add(cost);
  c.inverse_cost.Add(RobustCost((slope + v).squaredNorm(), size));
  c.body_gain.Add(cost - RobustCost((slope - turned).squaredNorm(), size));
  const Vec3 step_B = R_WB.transpose() * step;
  c.path_B += step_B;
  c.abs_path_B += step_B.cwiseAbs();
}

std::optional<Finding> VelocityCheck::UnitFinding(std::size_t source) const {
  const Course& c = courses_[source];
  const double slope = RmsOf(c.slope_squares), velocity = RmsOf(c.velocity_squares);
  constexpr double kThousand = 1e3;
  const bool by_velocity = velocity > 1e-3 && IsAbout(slope / velocity, kThousand);
  const bool by_speed = slope > kLargestSpeed_mps && slope < kThousand * kLargestSpeed_mps &&
                        !IsAbout(slope / velocity, 1.0 / kThousand);
  if (by_velocity || by_speed) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kMillimetres, kPositions[source]);
    f.size = kThousand;
    f.evidence =
        fmt::format("it moves at {:.4g} m/s rms{}", slope,
                    by_velocity ? fmt::format(", {:.0f} times the velocity", slope / velocity)
                                : ", faster than any legged robot");
    f.repair = fmt::format("mapping: {}: {{unit: mm}}", f.signal);
    return f;
  }
  if (slope > 1e-2 && IsAbout(velocity / slope, kThousand)) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kMillimetres, kVelocities[source]);
    f.size = kThousand;
    f.evidence = fmt::format("it is {:.0f} times the derivative of the position", velocity / slope);
    f.repair = fmt::format("mapping: {}: {{unit: mm/s}}", f.signal);
    return f;
  }
  return std::nullopt;
}

std::optional<Finding> VelocityCheck::FrameFinding(std::size_t source) const {
  const Course& c = courses_[source];
  if (c.body_gain.count() < 6 * BlockMean::kBlock || RmsOf(c.slope_squares) < 0.05)
    return std::nullopt;
  const SignalId signal = kVelocities[source];
  const double gain = c.body_gain.mean(), t = c.body_gain.t();
  if (gain > 0.1 && t > kSureAbove_t) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kVelocityFrame, signal);
    f.size = gain;
    f.evidence = fmt::format(
        "it is in the axes of the trunk, not of the world: by the position (cost {:.2f} less, "
        "{:.0f} standard errors)",
        gain, std::min(t, 99.0));
    f.repair = fmt::format("mapping: {}: {{frame: body}}", f.signal);
    return f;
  }
  if (c.cost.mean() > 0.5 * kLargestCost) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kVelocity, signal);
    const bool is_opposite = c.inverse_cost.mean() < 0.2 * kLargestCost;
    f.evidence =
        fmt::format("it is not the derivative of the position{}: {:.3f} against {:.3f} m/s rms",
                    is_opposite ? ", but the opposite of it" : "", RmsOf(c.velocity_squares),
                    RmsOf(c.slope_squares));
    return f;
  }
  if (std::abs(gain) < 0.02 && std::abs(t) < kSureAbove_t) {
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, signal);
    f.spoils.reset();
    f.evidence = "not enough turning to tell the world's axes from the trunk's";
    return f;
  }
  return std::nullopt;
}

std::optional<Finding> VelocityCheck::Backwards(std::size_t source) const {
  const Course& c = courses_[source];
  const double forward_m = c.path_B.x(), all_m = c.abs_path_B.x();
  if (forward_m > -0.3 || -forward_m < 0.7 * all_m) return std::nullopt;
  Finding f = MakeFinding(Severity::kNote, FindingKind::kWalksBackwards, kPositions[source]);
  f.spoils.reset();
  f.size = -forward_m;
  f.evidence = fmt::format("the robot walks {:.2f} m backwards", -forward_m);
  return f;
}

std::vector<Finding> VelocityCheck::JudgeSource(std::size_t source,
                                                const std::vector<Finding>& earlier) const {
  if (courses_[source].slope_squares.count() == 0) return {};
  if (const auto unit = UnitFinding(source)) return {*unit};
  std::vector<Finding> findings;
  const bool has_attitude =
      !HasError(earlier, {FindingKind::kQuaternionOrder, FindingKind::kRollPitchSwapped,
                          FindingKind::kAttitudeSign, FindingKind::kDegrees});
  if (has_attitude) {
    if (const auto frame = FrameFinding(source)) findings.push_back(*frame);
    if (const auto backwards = Backwards(source)) findings.push_back(*backwards);
  }
  if (const SpanList& jumps = courses_[source].jumps; jumps.count() > 0) {
    Finding f = MakeFinding(Severity::kWarning, FindingKind::kJump, kPositions[source]);
    f.spans = jumps.spans();
    f.count = jumps.count();
    f.evidence =
        fmt::format("it jumps {} times, faster than {:.0f} m/s", f.count, kLargestSpeed_mps);
    findings.push_back(f);
  }
  return findings;
}

std::vector<Finding> VelocityCheck::Conclude(const std::vector<Finding>& earlier) const {
  std::vector<Finding> findings;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    for (const Finding& f : JudgeSource(s, earlier)) findings.push_back(f);
  }
  return findings;
}

}  // namespace scoria::logs
