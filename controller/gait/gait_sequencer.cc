// SPDX-License-Identifier: BSD-3-Clause
#include "controller/gait/gait_sequencer.h"

#include <algorithm>
#include <cmath>

#include "core/math/moving_mean.h"

namespace scoria::controller {
namespace {

constexpr int kMaxSpeedSamples = 100;

LegArray<double> ToLegArray(const std::array<double, 4>& a) noexcept {
  return {a[0], a[1], a[2], a[3]};
}

double CommandedSpeed(const Command& command, double yaw_arm_m) noexcept {
  return std::max(std::hypot(command.v_x_mps, command.v_y_mps),
                  yaw_arm_m * std::abs(command.w_z_radps));
}

/// Decides between walking and standing, with hysteresis on the body speed.
class WalkSwitch {
 public:
  explicit WalkSwitch(const StandParams& params) noexcept : params_(params) {}
  [[nodiscard]] bool Update(const Command& command, double v_xy_mps) noexcept {
    const double threshold = walking_ ? params_.stop_below_mps : params_.step_above_mps;
    walking_ = !command.IsStop() || v_xy_mps > threshold;
    return walking_;
  }

 private:
  StandParams params_;
  bool walking_ = false;
};

class SimpleGait final : public GaitSequencer {
 public:
  explicit SimpleGait(const SgsParams& params) noexcept
      : timing_(params.Timing()), walk_(params.stand) {}

  ContactPlan Plan(const GaitInput& in) noexcept override {
    const bool walking = timing_.duty < 1.0 && walk_.Update(in.command, in.v_xy_mps);
    engine_.Update(timing_, in.dt_s, walking, LegArray<bool>(false));
    return engine_.Predict(in.horizon, in.stage_s);
  }

 private:
  GaitTiming timing_;
  WalkSwitch walk_;
  PhaseEngine engine_;
};

class AdaptiveGait final : public GaitSequencer {
 public:
  explicit AdaptiveGait(const AgsParams& params) noexcept
      : params_(params), walk_(params.stand), speed_(params.speed_filter_samples) {}

  ContactPlan Plan(const GaitInput& in) noexcept override {
    const double measured = speed_.Update(in.v_xy_mps);
    const double v =
        std::max({measured, params_.yaw_arm_m * std::abs(in.w_z_radps),
                  params_.command_share * CommandedSpeed(in.command, params_.yaw_arm_m)});
    GaitTiming timing = params_.law.Timing(v, in.height_m);
    timing.offset = ToLegArray(params_.offset);
    engine_.Update(timing, in.dt_s, walk_.Update(in.command, in.v_xy_mps), in.early_contact);
    return engine_.Predict(in.horizon, in.stage_s);
  }

 private:
  AgsParams params_;
  WalkSwitch walk_;
  core::MovingMean<double, kMaxSpeedSamples> speed_;
  PhaseEngine engine_;
};

class MatchedGait final : public GaitSequencer {
 public:
  MatchedGait(const SgsMatchedParams& params, double nominal_height_m) noexcept
      : params_(params), nominal_height_m_(nominal_height_m), walk_(params.stand) {}

  ContactPlan Plan(const GaitInput& in) noexcept override {
    const double v = CommandedSpeed(in.command, params_.yaw_arm_m);
    if (v > 0.0) timing_ = params_.law.Timing(v, nominal_height_m_);
    timing_.offset = ToLegArray(params_.offset);
    engine_.Update(timing_, in.dt_s, walk_.Update(in.command, in.v_xy_mps), LegArray<bool>(false));
    return engine_.Predict(in.horizon, in.stage_s);
  }

 private:
  SgsMatchedParams params_;
  double nominal_height_m_;
  GaitTiming timing_;
  WalkSwitch walk_;
  PhaseEngine engine_;
};

}  // namespace

GaitTiming TimingOf(NamedGait gait) noexcept {
  constexpr double kGallop = 0.8571, kGallopHind = 0.3571;
  switch (gait) {
    case NamedGait::kStand:
      return {0.5, 1.0, {0.0, 0.0, 0.0, 0.0}};
    case NamedGait::kStaticWalk:
      return {1.25, 0.8, {0.0, 0.5, 0.75, 0.25}};
    case NamedGait::kWalkingTrot:
      return {0.5, 0.6, {0.0, 0.5, 0.5, 0.0}};
    case NamedGait::kTrot:
      return {0.5, 0.5, {0.0, 0.5, 0.5, 0.0}};
    case NamedGait::kFlyingTrot:
      return {0.4, 0.4, {0.0, 0.5, 0.5, 0.0}};
    case NamedGait::kPace:
      return {0.35, 0.5, {0.0, 0.5, 0.0, 0.5}};
    case NamedGait::kBound:
      return {0.4, 0.4, {0.0, 0.0, 0.5, 0.5}};
    case NamedGait::kRotaryGallop:
      return {0.4, 0.2, {0.0, kGallop, kGallopHind, 0.5}};
    case NamedGait::kTraverseGallop:
      return {0.5, 0.2, {0.0, kGallop, kGallopHind, 0.5}};
    case NamedGait::kPronk:
      return {0.5, 0.5, {0.0, 0.0, 0.0, 0.0}};
  }
  return {};
}

GaitTiming SgsParams::Timing() const noexcept {
  GaitTiming timing = TimingOf(gait);
  timing.period_s = period_s.value_or(timing.period_s);
  timing.duty = duty.value_or(timing.duty);
  if (offset) timing.offset = ToLegArray(*offset);
  return timing;
}

GaitTiming StrideLaw::Timing(double v_mps, double h_m) const noexcept {
  const double v = std::max(v_mps, min_speed_mps), h = std::max(h_m, 0.05);
  const double froude = v * v / (gravity_mps2 * h);
  const double stride_m = 2.3 * std::pow(froude, 0.3) * h;
  double period = std::min(stride_m / v, max_stance_travel_m / v + swing_s);
  period = std::clamp(period, swing_s / (1.0 - min_duty), swing_s / (1.0 - max_duty));
  GaitTiming timing;
  timing.period_s = period;
  timing.duty = 1.0 - swing_s / period;
  return timing;
}

std::unique_ptr<GaitSequencer> MakeGaitSequencer(const GaitParams& params,
                                                 double nominal_height_m) {
  struct Visitor {
    double height_m;
    std::unique_ptr<GaitSequencer> operator()(const SgsParams& p) const {
      return std::make_unique<SimpleGait>(p);
    }
    std::unique_ptr<GaitSequencer> operator()(const AgsParams& p) const {
      return std::make_unique<AdaptiveGait>(p);
    }
    std::unique_ptr<GaitSequencer> operator()(const SgsMatchedParams& p) const {
      return std::make_unique<MatchedGait>(p, height_m);
    }
  };
  return std::visit(Visitor{nominal_height_m}, params);
}

}  // namespace scoria::controller
