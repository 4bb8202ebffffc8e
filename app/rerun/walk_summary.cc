// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/walk_summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/episode/fall_params.h"
#include "core/math/so3.h"
#include "core/similarity.h"

namespace scoria::app {
namespace {

/// Velocities are means over so long; slots that differ by less from the step before are of it.
constexpr double kSlot_s = 0.25, kSame_mps = 0.02, kSame_radps = 0.03;

/// Makes steps of a velocity that changes at any time. A step's velocity is the mean over all of
/// it, so that way and turn are kept, however coarse the steps.
class Programme {
 public:
  /// @param yaw_rad  of the estimate.
  void Add(double time_s, const Vec3& v_x_v_y_w_z, double yaw_rad) {
    if (yaw_rad_) turned_rad_ += core::WrapToPi(yaw_rad - *yaw_rad_);
    yaw_rad_ = yaw_rad;
    if (slot_.count > 0 && time_s >= slot_.begin_s + kSlot_s) EndSlot();
    if (slot_.count == 0) {
      slot_.begin_s = time_s;
      slot_.heading_rad = turned_rad_;
    }
    slot_.sum += v_x_v_y_w_z;
    ++slot_.count;
  }

  /// The heading goes on from another one: that of another path.
  void Break() { yaw_rad_.reset(); }

  [[nodiscard]] std::vector<HeldVelocity> Finish() {
    if (slot_.count > 0) EndSlot();
    if (step_.count > 0) EndStep();
    return std::move(steps_);
  }

 private:
  struct Stretch {
    double begin_s = 0.0, heading_rad = 0.0;
    Vec3 sum = Vec3::Zero();
    std::uint64_t count = 0;
    [[nodiscard]] Vec3 Mean() const { return sum / static_cast<double>(count); }
  };

  void EndSlot() {
    if (step_.count > 0) {
      const Vec3 change = (slot_.Mean() - step_.Mean()).cwiseAbs();
      if (change.x() >= kSame_mps || change.y() >= kSame_mps || change.z() >= kSame_radps)
        EndStep();
    }
    if (step_.count == 0) {
      step_.begin_s = slot_.begin_s;
      step_.heading_rad = slot_.heading_rad;
    }
    step_.sum += slot_.sum;
    step_.count += slot_.count;
    slot_ = {};
  }

  void EndStep() {
    const Vec3 v = step_.Mean();
    steps_.push_back({step_.begin_s, v.x(), v.y(), v.z(), step_.heading_rad});
    step_ = {};
  }

  Stretch slot_, step_;
  std::optional<double> yaw_rad_;  // the last one
  double turned_rad_ = 0.0;
  std::vector<HeldVelocity> steps_;
};

/// Timing of the planned gait over the rows in which it moves.
class GaitMeter {
 public:
  void Add(const logs::PlanRow& plan) {
    ++count_;
    sum_ += plan.period_s;
    sum_squares_ += plan.period_s * plan.period_s;
    sum_duty_ += plan.duty;
    least_duty_ = std::min(least_duty_, plan.duty);
    most_duty_ = std::max(most_duty_, plan.duty);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const double turn = 2.0 * std::numbers::pi * (plan.phase[leg] - plan.phase[0]);
      offset_[leg] += Vec2(std::cos(turn), std::sin(turn));
    }
  }

  [[nodiscard]] std::optional<GaitSummary> Finish() const {
    if (count_ == 0) return std::nullopt;
    const auto n = static_cast<double>(count_);
    GaitSummary out{.period_s = sum_ / n, .duty = sum_duty_ / n};
    const double variance = std::max(0.0, sum_squares_ / n - out.period_s * out.period_s);
    out.period_share = std::sqrt(variance) / out.period_s;
    out.duty_range = most_duty_ - least_duty_;
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const double share =
          std::atan2(offset_[leg].y(), offset_[leg].x()) / (2.0 * std::numbers::pi);
      out.offset[leg] = share - std::floor(share);
    }
    return out;
  }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0.0, sum_squares_ = 0.0, sum_duty_ = 0.0, least_duty_ = 1.0, most_duty_ = 0.0;
  std::array<Vec2, 4> offset_ = {Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

/// Footholds, and how high feet swing between them.
class FeetMeter {
 public:
  explicit FeetMeter(analysis::FootholdRoughness& roughness) : roughness_(roughness) {}

  void Add(const LegArray<Vec3>& p_WF, const LegArray<bool>& contact) {
    for (const Leg leg : kLegs) {
      Foot& foot = feet_[leg];
      if (contact[leg]) {
        if (foot.top_m) EndSwing(foot, p_WF[leg].z());
        foot.sum += p_WF[leg];
        ++foot.count;
        continue;
      }
      if (foot.count > 0) foot.stood_m = foot.sum.z() / static_cast<double>(foot.count);
      if (foot.count > kLeastStance) roughness_.Add(foot.sum / static_cast<double>(foot.count));
      foot.sum.setZero();
      foot.count = 0;
      foot.top_m = std::max(foot.top_m.value_or(p_WF[leg].z()), p_WF[leg].z());
    }
  }

  void Break() {
    feet_ = {};
    roughness_.Break();
  }

  [[nodiscard]] std::optional<double> Lift_m() {
    if (lifts_m_.empty()) return std::nullopt;
    const auto middle = lifts_m_.begin() + static_cast<std::ptrdiff_t>(lifts_m_.size() / 2);
    std::nth_element(lifts_m_.begin(), middle, lifts_m_.end());
    return *middle;
  }

 private:
  static constexpr std::uint64_t kLeastStance = 5;  // rows: a shorter one is a touch
  struct Foot {
    Vec3 sum = Vec3::Zero();
    std::uint64_t count = 0;
    std::optional<double> stood_m = std::nullopt;  // mean height of the stance before the swing
    std::optional<double> top_m = std::nullopt;
  };
  /// A swing that ends lower than it began counts: its apex was meant over its begin. Over what one
  /// was meant that goes up is not known, because it touches earlier than planned, or later.
  void EndSwing(Foot& foot, double down_m) {
    if (foot.stood_m && down_m <= *foot.stood_m) lifts_m_.push_back(*foot.top_m - *foot.stood_m);
    foot.top_m.reset();
  }

  analysis::FootholdRoughness& roughness_;
  LegArray<Foot> feet_;
  std::vector<double> lifts_m_;
};

/// The estimate's velocity in the heading frame, and its yaw rate.
Vec3 WalkedVelocity(const RobotState& s, double yaw_rad) {
  const Vec3 v_H = core::RotationFromRpy({0.0, 0.0, -yaw_rad}) * s.v_WB;
  return {v_H.x(), v_H.y(), s.w_WB.z()};
}

/// Estimation with what the log has.
VariantSetup UntaredObserver(const LogInputs& inputs) {
  std::vector<std::string> set;
  if (inputs.torques)
    set = {"controller.adaptation.type=kf_plus", "controller.adaptation.tare.enabled=false"};
  if (!inputs.accelerometer) set.emplace_back("controller.estimator.type=leg_odometry");
  return SetUpVariant(inputs, set);
}

}  // namespace

WalkSummary SummariseWalk(const LogInputOptions& options, const LogInputs& inputs) {
  const VariantSetup setup = UntaredObserver(inputs);
  WalkSummary out;
  out.commanded = inputs.command;
  LogObserver observer(inputs, setup.params);
  const double stands_s =
      FallParams{}.stand_s * inputs.robot.similarity.Factor(core::dimension::kTime);
  Programme programme;
  GaitMeter gait;
  FeetMeter feet(out.roughness);
  std::optional<double> first_s;
  std::uint32_t segment = 0;
  double sum_mass_kg = 0.0;
  std::uint64_t mass_rows = 0;
  (void)ForEachInputRow(options, [&](const logs::Row& row) {
    if (!observer.Step(row)) return;
    if (!first_s && inputs.plan && !row.plan) return;  // the walking controller is not in charge
    if (!first_s) {
      first_s = row.time_s;
      out.before_s = row.time_s - inputs.first_s;
    }
    out.duration_s = row.time_s - *first_s;
    const core::WholeBody& wb = observer.wb();
    const double yaw_rad = core::RpyFromRotation(wb.state.R_WB).z();
    if (observer.segment() != segment) {
      programme.Break();
      feet.Break();
    }
    segment = observer.segment();
    const double since_s = out.duration_s - stands_s;
    if (row.command) {
      const logs::CommandRow& c = *row.command;
      if (since_s >= 0.0) programme.Add(since_s, {c.v_x_mps, c.v_y_mps, c.w_z_radps}, yaw_rad);
      const bool moves = c.v_x_mps != 0.0 || c.v_y_mps != 0.0 || c.w_z_radps != 0.0;
      if (row.plan && moves && row.plan->period_s > 0.0) gait.Add(*row.plan);
    } else if (!inputs.command && since_s >= 0.0) {
      programme.Add(since_s, WalkedVelocity(wb.state, yaw_rad), yaw_rad);
    }
    feet.Add(wb.p_WF, observer.sensed().contact.contact);
    const controller::Adaptation& learned = observer.sensed().adaptation;
    if (learned.mass_kg <= 0.0 || row.time_s < 0.5 * (inputs.first_s + inputs.last_s)) return;
    sum_mass_kg += learned.mass_kg;
    ++mass_rows;
  });
  out.velocities = programme.Finish();
  out.gait = gait.Finish();
  out.swing_lift_m = feet.Lift_m();
  if (mass_rows > 0) out.mass_kg = sum_mass_kg / static_cast<double>(mass_rows);
  return out;
}

}  // namespace scoria::app
