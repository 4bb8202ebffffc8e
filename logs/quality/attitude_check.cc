// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/attitude_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/math/so3.h"
#include "logs/quality/leg_load.h"

namespace scoria::logs {
namespace {

using Reading = AttitudeCheck::Reading;

struct ReadingText {
  FindingKind kind;
  const char* found;
  const char* repair;
};
constexpr std::array<ReadingText, AttitudeCheck::kNumAttitudes> kTexts = {{
    {FindingKind::kNotJudged, "", ""},
    {FindingKind::kQuaternionOrder, "w, x, y, z was read as x, y, z, w", "attitude: {order: wxyz}"},
    {FindingKind::kQuaternionOrder, "x, y, z, w was read as w, x, y, z", "attitude: {order: xyzw}"},
    {FindingKind::kRollPitchSwapped, "roll and pitch are exchanged",
     "attitude: {fields: roll, pitch, yaw in this order}"},
    {FindingKind::kAttitudeSign,
     "it is the inverse of the attitude, or the rate has the other sign",
     "attitude: the inverse rotation, or imu.rate: axes with the other signs"},
    {FindingKind::kAttitudeSign, "pitch and yaw have the other sign: z points down",
     "attitude: pitch and yaw with the other sign"},
    {FindingKind::kAttitudeSign, "roll has the other sign", "attitude: roll with the other sign"},
    {FindingKind::kAttitudeSign, "pitch has the other sign", "attitude: pitch with the other sign"},
}};

/// The ways to turn axes by quarters, but for leaving them as they are: row i has the axis that is
/// our i.
const std::vector<Mat3>& TurnedAxes() {
  static const std::vector<Mat3> kAll = [] {
    std::vector<Mat3> all;
    std::array<int, 3> from = {0, 1, 2};
    do {
      for (unsigned signs = 0; signs < 8; ++signs) {
        Mat3 turn = Mat3::Zero();
        for (int i = 0; i < 3; ++i)
          turn(i, from[static_cast<std::size_t>(i)]) = (signs >> i & 1U) != 0 ? -1.0 : 1.0;
        if (turn.determinant() > 0.0 && turn != Mat3::Identity()) all.push_back(turn);
      }
    } while (std::next_permutation(from.begin(), from.end()));
    return all;
  }();
  return kAll;
}

/// "[y, x, -z]", as mappings have it.
std::string DescribeAxes(const Mat3& turn) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (turn(i, j) != 0.0)
        text += fmt::format("{}{}{}", i == 0 ? "[" : ", ", turn(i, j) < 0.0 ? "-" : "", "xyz"[j]);
    }
  }
  return text + "]";
}

struct Words {
  FindingKind kind;
  std::string found, repair;
};

Words Describe(std::size_t reading) {
  if (reading < kTexts.size())
    return {kTexts[reading].kind, kTexts[reading].found, kTexts[reading].repair};
  const std::string axes = DescribeAxes(TurnedAxes()[reading - kTexts.size()]);
  return {FindingKind::kAttitudeSign,
          fmt::format("x, y, z of the attitude are {} of gyroscope and accelerometer", axes),
          fmt::format("imu.rate, imu.acceleration: axes {}", axes)};
}

/// The attitude that was meant, if that was done to it.
Mat3 Undo(Reading reading, const Vec3& rpy) {
  const auto quaternion = [&] { return Quat(core::RotationFromRpy(rpy)); };
  switch (reading) {
    case Reading::kAsIs:
      break;
    case Reading::kScalarFirstReadLast: {
      const Quat q = quaternion();
      return Quat(q.x(), q.y(), q.z(), q.w()).toRotationMatrix();
    }
    case Reading::kScalarLastReadFirst: {
      const Quat q = quaternion();
      return Quat(q.z(), q.w(), q.x(), q.y()).toRotationMatrix();
    }
    case Reading::kRollPitchSwapped:
      return core::RotationFromRpy({rpy.y(), rpy.x(), rpy.z()});
    case Reading::kInverse:
      return core::RotationFromRpy(rpy).transpose();
    case Reading::kPitchYawSigns:
      return core::RotationFromRpy({rpy.x(), -rpy.y(), -rpy.z()});
    case Reading::kRollSign:
      return core::RotationFromRpy({-rpy.x(), rpy.y(), rpy.z()});
    case Reading::kPitchSign:
      return core::RotationFromRpy({rpy.x(), -rpy.y(), rpy.z()});
  }
  return core::RotationFromRpy(rpy);
}

/// How the trunk turned from one attitude to another, as rotation vectors, and the latter.
struct Turn {
  Vec3 by_B = Vec3::Zero(), by_W = Vec3::Zero();
  Mat3 R_end = Mat3::Identity();
};

Turn CalcTurn(const Mat3& R_begin, const Mat3& R_end) {
  return {core::LogSo3(R_begin.transpose() * R_end), core::LogSo3(R_end * R_begin.transpose()),
          R_end};
}

/// By every reading; those of other axes follow from the attitudes as they are.
std::array<Turn, AttitudeCheck::kNumReadings> CalcTurns(const Vec3& rpy_begin, const Vec3& rpy_end,
                                                        const Mat3& R_SB) {
  std::array<Turn, AttitudeCheck::kNumReadings> turns;
  for (std::size_t r = 0; r < AttitudeCheck::kNumAttitudes; ++r) {
    const auto reading = static_cast<Reading>(r);
    turns[r] = CalcTurn(Undo(reading, rpy_begin) * R_SB, Undo(reading, rpy_end) * R_SB);
  }
  const Mat3 R_BS = R_SB.transpose();
  for (std::size_t k = 0; k < TurnedAxes().size(); ++k) {
    const Mat3 turn = R_BS * TurnedAxes()[k] * R_SB;
    turns[AttitudeCheck::kNumAttitudes + k] = {turn.transpose() * turns[0].by_B, turns[0].by_W,
                                               turns[0].R_end * turn};
  }
  return turns;
}

double RateCost(const Vec3& by_attitude, const Vec3& rate) {
  return RobustCost((by_attitude - rate).squaredNorm(), 0.05 + 0.15 * rate.norm());
}

double TiltCost(const Vec3& up_W) {
  constexpr double kSize_rad = 0.2;
  const double tilt = std::atan2(up_W.head<2>().norm(), up_W.z());
  return RobustCost(tilt * tilt, kSize_rad);
}

/// A gain in cost below which two readings explain the log alike.
constexpr double kLeastAttitudeGain = 0.1;

}  // namespace

const BlockMean& AttitudeCheck::Evidence::BestRate() const noexcept {
  return turned_rate.count() > 0 && turned_rate.mean() > rate.mean() ? turned_rate : rate;
}

double AttitudeCheck::Evidence::gain() const noexcept { return BestRate().mean() + gravity.mean(); }

void AttitudeCheck::AddTick(const Tick& tick) {
  last_.Add(tick);
  if (tick.is_first) up_B_.reset();
  std::optional<Vec3> up = tick.a_WS_B;
  if (!up && subject_.robot != nullptr) {
    up = CalcForceOfFeet(*subject_.robot, tick);
    if (up && up->norm() < 0.3 * subject_.robot->total_mass_kg() * subject_.gravity_mps2)
      up.reset();
  }
  constexpr double kMemory_s = 0.3;
  if (up) up_B_ = up_B_ ? Vec3(*up_B_ + kTick_s / kMemory_s * (*up - *up_B_)) : *up;
  if (!last_.IsFull()) return;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    if (last_[0].rpy_rad[s] && last_[4].rpy_rad[s]) AddSource(s);
  }
}

void AttitudeCheck::AddSource(std::size_t source) {
  const Tick &begin = last_[0], &mid = last_[2], &end = last_[4];
  constexpr double kSpan_s = 4.0 * kTick_s;
  const bool is_imu = source == static_cast<std::size_t>(MotionSource::kImu);
  Mat3 R_SB = Mat3::Identity();
  if (is_imu && subject_.robot != nullptr) R_SB = subject_.robot->R_BS.transpose();
  const auto turns = CalcTurns(*begin.rpy_rad[source], *end.rpy_rad[source], R_SB);
  const bool by_truth = !mid.w_WB_B && mid.w_true && mid.R_WB[source];
  std::array<double, 3> as_is{};
  for (std::size_t r = 0; r < kNumReadings; ++r) {
    const Turn& turn = turns[r];
    Evidence& evidence = evidence_[source][r];
    if (mid.w_WB_B) {
      const double cost = RateCost(turn.by_B / kSpan_s, *mid.w_WB_B);
      if (r == 0) as_is[0] = cost;
      evidence.rate.Add(as_is[0] - cost);
    } else if (by_truth) {
      const double cost = RateCost(turn.by_W / kSpan_s, *mid.w_true);
      const Vec3 w_B = mid.R_WB[source]->transpose() * *mid.w_true;
      const double turned = RateCost(turn.by_B / kSpan_s, w_B);
      if (r == 0) as_is[0] = cost, as_is[1] = turned;
      evidence.rate.Add(as_is[0] - cost);
      evidence.turned_rate.Add(as_is[1] - turned);
    }
    if (up_B_) {
      const double cost = TiltCost(turn.R_end * *up_B_);
      if (r == 0) as_is[2] = cost;
      evidence.gravity.Add(as_is[2] - cost);
    }
  }
}

std::vector<Finding> AttitudeCheck::JudgeSource(std::size_t source,
                                                const std::vector<Finding>& earlier) const {
  const auto& readings = evidence_[source];
  const SignalId signal = kAttitudeSignals[source];
  if (std::max(readings[0].rate.count(), readings[0].gravity.count()) < 6 * BlockMean::kBlock ||
      std::any_of(earlier.begin(), earlier.end(), [&](const Finding& f) {
        return f.kind == FindingKind::kDegrees && f.signal == TraitsOf(signal).key;
      }))
    return {};
  const auto best =
      std::max_element(readings.begin(), readings.end(),
                       [](const Evidence& a, const Evidence& b) { return a.gain() < b.gain(); });
  const Words text = Describe(static_cast<std::size_t>(best - readings.begin()));
  const bool has_rate = best->rate.count() > 0;
  const BlockMean& rate = best->BestRate();
  // The accelerometer may be wrong itself; the rate has to agree where there is one.
  const BlockMean& judge = has_rate ? rate : best->gravity;
  if (best != readings.begin() && judge.mean() > kLeastAttitudeGain && judge.t() > kSureAbove_t) {
    Finding f = MakeFinding(Severity::kError, text.kind, signal);
    f.size = best->gain();
    f.evidence = fmt::format(
        "{}: then it agrees with {} (cost {:.2f} less of {:.0f} at most, {:.0f} standard errors)",
        text.found, has_rate ? "the rate of the trunk" : "what holds the robot up", judge.mean(),
        kLargestCost, std::min(judge.t(), 99.0));
    f.repair = fmt::format("mapping: {}", text.repair);
    return {f};
  }
  const Evidence& swapped = readings[static_cast<std::size_t>(Reading::kRollPitchSwapped)];
  if (has_rate && std::abs(swapped.BestRate().t()) < kSureAbove_t &&
      std::abs(swapped.gain()) < kLeastAttitudeGain) {
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, signal);
    f.spoils.reset();
    f.evidence = "not enough motion to tell roll from pitch";
    return {f};
  }
  return {};
}

std::vector<Finding> AttitudeCheck::Conclude(const std::vector<Finding>& earlier) const {
  std::vector<Finding> findings;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    for (const Finding& f : JudgeSource(s, earlier)) findings.push_back(f);
  }
  return findings;
}

}  // namespace scoria::logs
