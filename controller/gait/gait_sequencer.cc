// SPDX-License-Identifier: BSD-3-Clause
#include "controller/gait/gait_sequencer.h"

#include <algorithm>
#include <cmath>

#include "core/math/moving_mean.h"

namespace scoria::controller {
namespace {

constexpr int kMaxSpeedSamples = 100;
constexpr double kLeastHeight_m = 0.05;

LegArray<double> ToLegArray(const std::array<double, 4>& a) noexcept {
  return {a[0], a[1], a[2], a[3]};
}

double CommandedSpeed(const Command& command, double yaw_arm_m) noexcept {
  return std::max(std::hypot(command.v_x_mps, command.v_y_mps),
                  yaw_arm_m * std::abs(command.w_z_radps));
}

LegArray<double> OffsetsOf(GaitPattern pattern) noexcept {
  switch (pattern) {
    case GaitPattern::kWalk:
      return TimingOf(NamedGait::kStaticWalk).offset;
    case GaitPattern::kPace:
      return TimingOf(NamedGait::kPace).offset;
    case GaitPattern::kTrot:
    case GaitPattern::kOwn:
      break;
  }
  return TimingOf(NamedGait::kTrot).offset;
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

/// Longer stances between swings of the same duration.
GaitTiming WithLeastDuty(GaitTiming timing, double least_duty) noexcept {
  if (timing.duty >= least_duty) return timing;
  timing.period_s *= (1.0 - timing.duty) / (1.0 - least_duty);
  timing.duty = least_duty;
  return timing;
}

/// What all gaits share: the clock of the phases, standing, and single steps while standing.
class PhasedGait : public GaitSequencer {
 public:
  explicit PhasedGait(const StandParams& stand) noexcept : stand_(stand), walk_(stand) {}

  ContactPlan Plan(const GaitInput& in) noexcept final {
    GaitTiming timing = WithLeastDuty(Timing(in), in.least_duty);
    if (in.command.pattern != GaitPattern::kOwn) timing.offset = OffsetsOf(in.command.pattern);
    const bool walking = timing.duty < 1.0 && walk_.Update(in.command, in.v_xy_mps);
    if (!walking) timing = StandingTiming(in, timing);
    engine_.Update(timing, in.dt_s, walking,
                   ends_swings_early() ? in.early_contact : LegArray<bool>(false));
    return engine_.Predict(in.horizon, in.stage_s);
  }
  const PhaseEngine& phases() const noexcept final { return engine_; }
  void Continue(const PhaseEngine& phases) noexcept final { engine_ = phases; }

 private:
  [[nodiscard]] virtual GaitTiming Timing(const GaitInput& in) noexcept = 0;
  /// Whether an early touchdown starts the next stance at once.
  [[nodiscard]] virtual bool ends_swings_early() const noexcept { return true; }

  /// While standing, the foot that is furthest from its place steps there if it is far enough.
  [[nodiscard]] GaitTiming StandingTiming(const GaitInput& in, const GaitTiming& timing) noexcept {
    constexpr double kSwingShare = 1.0 / 3.0;
    GaitTiming step = timing;
    step.period_s = stand_.correction_period_s;
    step.duty = 1.0 - kSwingShare;
    if (!engine_.standing()) {
      rest_s_ = 0.0;
      return correcting_ ? step : timing;
    }
    correcting_ = false;
    rest_s_ += in.dt_s;
    const auto worst = std::max_element(in.foot_error_m.begin(), in.foot_error_m.end());
    if (*worst <= stand_.correct_above_m || rest_s_ < step.duty * step.period_s) return timing;
    correcting_ = true;
    engine_.Step(kLegs[static_cast<std::size_t>(worst - in.foot_error_m.begin())], step);
    return step;
  }

  StandParams stand_;
  WalkSwitch walk_;
  PhaseEngine engine_;
  double rest_s_ = 0.0;
  bool correcting_ = false;
};

class AdaptedSpeed {
 public:
  explicit AdaptedSpeed(const SpeedParams& params) noexcept
      : params_(params), filter_(params.filter_samples) {}
  [[nodiscard]] double Update(const GaitInput& in) noexcept {
    const double measured = filter_.Update(in.v_xy_mps);
    return std::max({measured, params_.yaw_arm_m * std::abs(in.w_z_radps),
                     params_.command_share * CommandedSpeed(in.command, params_.yaw_arm_m)});
  }

 private:
  SpeedParams params_;
  core::MovingMean<double, kMaxSpeedSamples> filter_;
};

/// Offsets of the gait, or of a walk while it is slow.
class OffsetSwitch {
 public:
  OffsetSwitch(const SlowWalkParams& params, const std::array<double, 4>& offset) noexcept
      : params_(params), own_(ToLegArray(offset)) {}
  [[nodiscard]] LegArray<double> Update(double froude, double dt_s) noexcept {
    const bool slow = froude < params_.walk_below_froude;
    wanted_s_ = slow == walks_ ? 0.0 : wanted_s_ + dt_s;
    if (wanted_s_ > params_.offset_delay_s) {
      walks_ = slow;
      wanted_s_ = 0.0;
    }
    return walks_ ? OffsetsOf(GaitPattern::kWalk) : own_;
  }

 private:
  SlowWalkParams params_;
  LegArray<double> own_;
  bool walks_ = false;
  double wanted_s_ = 0.0;  // that the speed has asked for the other offsets
};

class SimpleGait final : public PhasedGait {
 public:
  explicit SimpleGait(const SgsParams& params) noexcept
      : PhasedGait(params.stand), timing_(params.Timing()) {}

  std::unique_ptr<GaitSequencer> Clone() const override {
    return std::make_unique<SimpleGait>(*this);
  }

 private:
  GaitTiming Timing(const GaitInput&) noexcept override { return timing_; }
  bool ends_swings_early() const noexcept override { return false; }

  GaitTiming timing_;
};

class AdaptiveGait final : public PhasedGait {
 public:
  explicit AdaptiveGait(const AgsParams& params) noexcept
      : PhasedGait(params.stand),
        law_(params.law),
        speed_(params.speed),
        offsets_(params.slow_walk, params.offset) {}

  std::unique_ptr<GaitSequencer> Clone() const override {
    return std::make_unique<AdaptiveGait>(*this);
  }

 private:
  GaitTiming Timing(const GaitInput& in) noexcept override {
    const double v_mps = speed_.Update(in);
    GaitTiming timing = law_.Timing(v_mps, in.height_m);
    timing.offset = offsets_.Update(law_.Froude(v_mps, in.height_m), in.dt_s);
    return timing;
  }

  StrideLaw law_;
  AdaptedSpeed speed_;
  OffsetSwitch offsets_;
};

class MatchedGait final : public PhasedGait {
 public:
  MatchedGait(const SgsMatchedParams& params, double nominal_height_m) noexcept
      : PhasedGait(params.stand),
        params_(params),
        nominal_height_m_(nominal_height_m),
        offsets_(params.slow_walk, params.offset) {}

  std::unique_ptr<GaitSequencer> Clone() const override {
    return std::make_unique<MatchedGait>(*this);
  }

 private:
  GaitTiming Timing(const GaitInput& in) noexcept override {
    const double v = CommandedSpeed(in.command, params_.yaw_arm_m);
    if (v > 0.0) timing_ = params_.law.Timing(v, nominal_height_m_);
    timing_.offset = offsets_.Update(params_.law.Froude(v, nominal_height_m_), in.dt_s);
    return timing_;
  }
  bool ends_swings_early() const noexcept override { return false; }

  SgsMatchedParams params_;
  double nominal_height_m_;
  OffsetSwitch offsets_;
  GaitTiming timing_;
};

/// A band of Froude numbers below `upper` and the gait in it.
struct Band {
  double upper;
  GaitTiming timing;
};
constexpr std::array<Band, 4> kBands = {{{0.0024, {0.6, 0.75, {0.0, 0.5, 0.75, 0.25}}},
                                         {0.1517, {0.5, 0.6, {0.0, 0.5, 0.5, 0.0}}},
                                         {0.74, {0.4, 0.5, {0.0, 0.5, 0.5, 0.0}}},
                                         {1.0, {0.3, 0.4, {0.0, 0.5, 0.5, 0.0}}}}};

class BioGait final : public PhasedGait {
 public:
  explicit BioGait(const BioParams& params) noexcept
      : PhasedGait(params.stand), params_(params), speed_(params.speed) {
    from_.period_s = PeriodOf(0);
  }

  std::unique_ptr<GaitSequencer> Clone() const override { return std::make_unique<BioGait>(*this); }

 private:
  GaitTiming Timing(const GaitInput& in) noexcept override {
    const double v = speed_.Update(in);
    const double froude = v * v / (params_.gravity_mps2 * std::max(in.height_m, kLeastHeight_m));
    const std::size_t band = BandOf(froude);
    if (band != band_) {
      from_ = Blend();
      share_ = 0.0;
      const double boundary = std::min(kBands[std::min(band, band_)].upper, 0.95);
      const double mean_period_s = 0.5 * (from_.period_s + PeriodOf(band));
      blend_s_ = 2.0 * (1.0 - boundary) * mean_period_s;
      band_ = band;
    }
    share_ = std::min(1.0, share_ + in.dt_s / blend_s_);
    return Blend();
  }

  /// The present band, unless a boundary has been passed by the hysteresis.
  [[nodiscard]] std::size_t BandOf(double froude) const noexcept {
    std::size_t band = band_;
    while (band + 1 < kBands.size() && froude > kBands[band].upper * (1.0 + params_.hysteresis))
      ++band;
    while (band > 0 && froude < kBands[band - 1].upper * (1.0 - params_.hysteresis)) --band;
    return band;
  }

  [[nodiscard]] double PeriodOf(std::size_t band) const noexcept {
    return params_.period_scale * kBands[band].timing.period_s;
  }

  [[nodiscard]] GaitTiming Blend() const noexcept {
    const GaitTiming& to = kBands[band_].timing;
    GaitTiming timing;
    timing.period_s = from_.period_s + share_ * (PeriodOf(band_) - from_.period_s);
    timing.duty = from_.duty + share_ * (to.duty - from_.duty);
    for (const Leg leg : kLegs) {
      const double difference = to.offset[leg] - from_.offset[leg];
      const double shortest = difference - std::floor(difference + 0.5);
      const double offset = from_.offset[leg] + share_ * shortest;
      timing.offset[leg] = offset - std::floor(offset);
    }
    return timing;
  }

  BioParams params_;
  AdaptedSpeed speed_;
  std::size_t band_ = 0;
  GaitTiming from_ = kBands[0].timing;
  double share_ = 1.0, blend_s_ = 1.0;
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
  timing.period_s = period_s.value_or(period_scale * timing.period_s);
  timing.duty = duty.value_or(timing.duty);
  if (offset) timing.offset = ToLegArray(*offset);
  return timing;
}

double StrideLaw::Froude(double v_mps, double h_m) const noexcept {
  const double v = std::max(v_mps, min_speed_mps);
  return v * v / (gravity_mps2 * std::max(h_m, kLeastHeight_m));
}

GaitTiming StrideLaw::Timing(double v_mps, double h_m) const noexcept {
  const double v = std::max(v_mps, min_speed_mps), h = std::max(h_m, kLeastHeight_m);
  const double stride_m = 2.3 * std::pow(Froude(v_mps, h_m), 0.3) * h;
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
    std::unique_ptr<GaitSequencer> operator()(const BioParams& p) const {
      return std::make_unique<BioGait>(p);
    }
  };
  return std::visit(Visitor{nominal_height_m}, params);
}

}  // namespace scoria::controller
