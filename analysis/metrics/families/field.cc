// SPDX-License-Identifier: BSD-3-Clause
// Numbers that need no truth: they are for logs of robots, and tell of simulations the same.
#include <algorithm>
#include <cmath>

#include "analysis/metrics/families/families.h"
#include "analysis/signals/stance_slip.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

bool IsWalking(const logs::Row& row) { return row.episode->operating && !row.episode->fallen; }

constexpr double kGravity_mps2 = 9.81;

/// Mean over rows of sum |tau w| / (m g v), as the reference framework's script has it.
class CostOfSamples final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    const auto& m = *row.measured;
    const double v_mps = std::hypot(row.truth->v_WB_mps[0], row.truth->v_WB_mps[1]);
    if (!IsWalking(row) || !m.tau_Nm || !m.qd_radps || v_mps == 0.0) return;
    double power_W = 0.0;
    for (std::size_t k = 0; k < m.tau_Nm->size(); ++k)
      power_W += std::abs((*m.tau_Nm)[k] * (*m.qd_radps)[k]);
    sum_ += power_W / (row.true_mass->mass_kg * kGravity_mps2 * v_mps);
    ++rows_;
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    return MeasuredIf(rows_ > 0.0, sum_ / rows_, rows_);
  }

 private:
  double sum_ = 0.0, rows_ = 0.0;
};

/// Of the learned model: its mean, or its deviation within windows of ten seconds.
template <double (*number)(const logs::LearnedModel&), bool is_noise>
class Learned final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    if (!IsWalking(row) || !row.model->learned || !row.model->learned->tared) return;
    constexpr double kWindow_s = 10.0;
    if (row.time_s - start_s_ > kWindow_s || count_ == 0.0) CloseWindow(row.time_s);
    const double value = number(*row.model->learned);
    ++count_;
    const double step = value - mean_;
    mean_ += step / count_;
    squares_ += step * (value - mean_);
    sum_ += value;
    ++rows_;
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    const double degrees = degrees_ + std::max(0.0, count_ - 1.0);
    const double noise = std::sqrt((all_squares_ + squares_) / std::max(1.0, degrees));
    return MeasuredIf(is_noise ? degrees > 0.0 : rows_ > 0.0, is_noise ? noise : sum_ / rows_,
                      rows_);
  }

 private:
  void CloseWindow(double time_s) {
    all_squares_ += squares_;
    degrees_ += std::max(0.0, count_ - 1.0);
    squares_ = mean_ = count_ = 0.0;
    start_s_ = time_s;
  }
  double start_s_ = 0.0, count_ = 0.0, mean_ = 0.0, squares_ = 0.0;  // of the window
  double all_squares_ = 0.0, degrees_ = 0.0, sum_ = 0.0, rows_ = 0.0;
};

double MassOf(const logs::LearnedModel& model) { return model.mass_kg; }
double ComXOf(const logs::LearnedModel& model) { return model.p_BC_m[0]; }
double ComYOf(const logs::LearnedModel& model) { return model.p_BC_m[1]; }

/// Mean vertical force of the feet over g.
class MassByFeet final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    if (!IsWalking(row) || !row.contacts->f_F_W_N) return;
    const logs::Array12& f = *row.contacts->f_F_W_N;
    sum_N_ += f[2] + f[5] + f[8] + f[11];
    ++rows_;
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    return MeasuredIf(rows_ > 0.0, sum_N_ / rows_ / kGravity_mps2, rows_);
  }

 private:
  double sum_N_ = 0.0, rows_ = 0.0;
};

class PlanAgreement final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    if (!IsWalking(row)) return;
    for (std::size_t leg = 0; leg < row.plan->stance.size(); ++leg) {
      if (row.plan->stance[leg] == row.contacts->contact[leg]) ++agreed_;
      ++rows_;
    }
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    return MeasuredIf(rows_ > 0.0, agreed_ / rows_, rows_);
  }

 private:
  double agreed_ = 0.0, rows_ = 0.0;
};

class StanceSlip final : public RowMetric {
 public:
  void AddRow(const logs::Row& row) override {
    slips_.AddRow(row, [this](double slip_m) {
      sum_m_ += slip_m;
      ++stances_;
    });
  }
  [[nodiscard]] std::optional<Measured> Value() const override {
    return MeasuredIf(stances_ > 0.0, sum_m_ / stances_, stances_);
  }

 private:
  StanceSlips slips_;
  double sum_m_ = 0.0, stances_ = 0.0;
};

MetricInfo LearnedInfo(std::string_view key, std::string_view title, std::string_view unit,
                       std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kModel,
          .unit = unit,
          .title = title,
          .digits = unit == "kg" ? 2 : 4,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kModel}),
          .pooled_over = "rows",
          .definition = definition};
}

constexpr std::string_view kMean = "Mean of what the adaptation learned while walking.";
constexpr std::string_view kNoise =
    "Standard deviation of what the adaptation learned, within windows of ten seconds.";

Metric CostOfSamplesMetric() {
  return {
      .info = {.key = "cot_samples",
               .family = MetricFamily::kTransport,
               .title = "CoT, mean of samples",
               .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kTrueMass,
                                RowGroup::kMeasured}),
               .better = Better::kLower,
               .pooled_over = "rows",
               .definition = "Mean over rows of Σ|τω| / (m g v), by the measured joints, as the "
                             "reference framework's script has it: without bound where v is "
                             "small.",
               .takes_substitutes = true},
      .make = MakeRowMetric<CostOfSamples>};
}

Metric SlipMetric() {
  return {
      .info = {.key = "stance_slip_m",
               .family = MetricFamily::kContact,
               .unit = "m",
               .title = "slip of a stance",
               .shown_unit = "mm",
               .scale = 1e3,
               .digits = 1,
               .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueContacts}),
               .better = Better::kLower,
               .pooled_over = "stances",
               .definition = "Mean horizontal distance of a foot between touchdown and lift-off.",
               .takes_substitutes = true},
      .make = MakeRowMetric<StanceSlip>};
}

Metric AgreementMetric() {
  return {
      .info = {.key = "contact_plan_agreement",
               .family = MetricFamily::kContact,
               .title = "contact as planned",
               .shown_unit = "%",
               .scale = 100.0,
               .digits = 1,
               .needs = Groups({RowGroup::kEpisode, RowGroup::kContacts, RowGroup::kPlan}),
               .pooled_over = "rows of legs",
               .definition = "Share of the rows of legs on which the fused contact is the planned "
                             "one."},
      .make = MakeRowMetric<PlanAgreement>};
}

Metric MassByFeetMetric() {
  return {.info = {.key = "mass_by_feet_kg",
                   .family = MetricFamily::kModel,
                   .unit = "kg",
                   .title = "mass by the feet",
                   .needs = Groups({RowGroup::kEpisode, RowGroup::kContacts}),
                   .pooled_over = "rows",
                   .definition =
                       "Mean sum of the estimated vertical forces of the feet over 9.81 m/s²."},
          .make = MakeRowMetric<MassByFeet>};
}

}  // namespace

Metrics FieldMetrics() {
  return {CostOfSamplesMetric(),
          SlipMetric(),
          AgreementMetric(),
          {.info = LearnedInfo("learned_mass_mean_kg", "learned mass: mean", "kg", kMean),
           .make = MakeRowMetric<Learned<MassOf, false>>},
          {.info = LearnedInfo("learned_mass_noise_kg", "learned mass: noise", "kg", kNoise),
           .make = MakeRowMetric<Learned<MassOf, true>>},
          {.info = LearnedInfo("learned_com_x_mean_m", "learned COM x: mean", "m", kMean),
           .make = MakeRowMetric<Learned<ComXOf, false>>},
          {.info = LearnedInfo("learned_com_x_noise_m", "learned COM x: noise", "m", kNoise),
           .make = MakeRowMetric<Learned<ComXOf, true>>},
          {.info = LearnedInfo("learned_com_y_mean_m", "learned COM y: mean", "m", kMean),
           .make = MakeRowMetric<Learned<ComYOf, false>>},
          {.info = LearnedInfo("learned_com_y_noise_m", "learned COM y: noise", "m", kNoise),
           .make = MakeRowMetric<Learned<ComYOf, true>>},
          MassByFeetMetric()};
}

}  // namespace scoria::analysis
