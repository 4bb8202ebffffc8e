// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/model_metrics.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "analysis/metrics/optional_json.h"
#include "core/math/quantile.h"

namespace scoria::analysis {
namespace {

constexpr double kMargin_kg = 0.25, kMarginShare = 0.1;  // of the step
constexpr double kSameMass_kg = 1e-9;                    // rounding of sums of masses
// Changes of mass closer than this are one: a gradual change need not show in every row, and one
// payload may be exchanged for another.
constexpr double kSameChange_s = 0.1;
constexpr double kRounding_s = 1e-9;

double Margin(double step_kg) { return std::max(kMargin_kg, kMarginShare * std::abs(step_kg)); }

template <class Get>
std::vector<double> Collect(const std::vector<ModelInterval>& intervals, Get get) {
  std::vector<double> values;
  for (const ModelInterval& i : intervals) {
    if (i.settled) values.push_back(get(i));
  }
  return values;
}

}  // namespace

const logs::LearnedModel* FindLearnedModel(const logs::Row& row) noexcept {
  const bool learned = row.model && row.model->learned && row.model->learned->tared;
  return learned ? &*row.model->learned : nullptr;
}

ModelSummary SummariseModel(const std::vector<ModelInterval>& intervals) {
  ModelSummary s;
  std::vector<double> settling_s, used_kg;
  for (const ModelInterval& i : intervals) {
    if (i.used_rows > 0) used_kg.push_back(std::abs(i.used_bias_kg));
    if (i.rows == 0) continue;
    settling_s.push_back(i.settling_s);
    s.settled += i.settled ? 1 : 0;
  }
  s.judged = static_cast<int>(settling_s.size());
  s.used = static_cast<int>(used_kg.size());
  if (s.used > 0) s.median_used_bias_kg = core::SampleQuantile(used_kg, 0.5);
  if (s.judged > 0) s.median_settling_s = core::SampleQuantile(settling_s, 0.5);
  if (s.settled == 0) return s;
  const std::vector<double> biases_kg =
      Collect(intervals, [](const auto& i) { return std::abs(i.bias_kg); });
  const auto median = [&intervals](auto get) {
    return core::SampleQuantile(Collect(intervals, get), 0.5);
  };
  s.median_bias_kg = core::SampleQuantile(biases_kg, 0.5);
  s.p95_bias_kg = core::SampleQuantile(biases_kg, 0.95);
  s.median_rmse_kg = median([](const auto& i) { return i.rmse_kg; });
  s.median_com_x_rmse_m = median([](const auto& i) { return i.com_x_rmse_m; });
  s.median_com_y_rmse_m = median([](const auto& i) { return i.com_y_rmse_m; });
  return s;
}

void ModelAccumulator::Sums::Add(double mass_error_kg, double com_x_error_m,
                                 double com_y_error_m) noexcept {
  ++rows;
  error_kg += mass_error_kg;
  error_kg2 += mass_error_kg * mass_error_kg;
  com_x_m += com_x_error_m;
  com_y_m += com_y_error_m;
  com_x_m2 += com_x_error_m * com_x_error_m;
  com_y_m2 += com_y_error_m * com_y_error_m;
}

void ModelAccumulator::AddRow(const logs::Row& row) {
  if (!row.episode || !row.true_mass || !row.model) return;
  const bool at_work = row.episode->operating && !row.episode->fallen;
  const bool learned = FindLearnedModel(row) != nullptr;
  if (at_work && learned && !metrics_.present) {
    // What came before was at best the model without adaptation.
    metrics_ = {.present = true, .intervals = {}};
    started_ = true;
    changed_ = false;
    Open(row, row.time_s, 0.0);
  } else if (at_work && !started_) {
    started_ = true;
    Open(row, row.time_s, 0.0);
  } else if (started_) {
    FollowMass(row);
  }
  if (at_work) Judge(row);
  last_s_ = row.time_s;
  last_mass_kg_ = row.true_mass->mass_kg;
}

/// Begins a new interval at every row of a change of mass: the one that lasts is the change's end.
void ModelAccumulator::FollowMass(const logs::Row& row) {
  const double mass_kg = row.true_mass->mass_kg;
  if (std::abs(mass_kg - last_mass_kg_) <= kSameMass_kg) return;
  const bool same_change = changed_ && row.time_s - interval_.start_s < kSameChange_s - kRounding_s;
  if (!same_change) {
    Close(row.time_s);
    change_s_ = row.time_s;
    mass_before_kg_ = last_mass_kg_;
  }
  changed_ = true;
  Open(row, change_s_, mass_kg - mass_before_kg_);
}

void ModelAccumulator::Open(const logs::Row& row, double change_s, double step_kg) noexcept {
  open_ = true;
  interval_ = {};
  interval_.start_s = row.time_s;
  interval_.mass_kg = row.true_mass->mass_kg;
  interval_.step_kg = step_kg;
  change_s_ = change_s;
  settled_ = late_ = {};
  all_used_kg_ = 0.0;
  all_used_rows_ = 0;
}

void ModelAccumulator::Judge(const logs::Row& row) noexcept {
  const logs::TrueMassRow& truth = *row.true_mass;
  const double used_error_kg = row.model->used_mass_kg - truth.mass_kg;
  all_used_kg_ += used_error_kg;
  ++all_used_rows_;
  const logs::LearnedModel* learned = FindLearnedModel(row);
  if (learned == nullptr) return;
  ++interval_.rows;
  const double error_kg = learned->mass_kg - truth.mass_kg;
  const double com_x_m = learned->p_BC_m[0] - truth.p_BC_m[0];
  const double com_y_m = learned->p_BC_m[1] - truth.p_BC_m[1];
  if (row.time_s - change_s_ >= kLate_s - kRounding_s) late_.Add(error_kg, com_x_m, com_y_m);
  interval_.settled = std::abs(error_kg) <= Margin(interval_.step_kg);
  if (!interval_.settled) {
    interval_.settling_s = row.time_s - change_s_;
    settled_ = {};
    return;
  }
  settled_.Add(error_kg, com_x_m, com_y_m);
  settled_.used_kg += used_error_kg;
  ++settled_.used_rows;
}

void ModelAccumulator::Close(double end_s) {
  if (!open_) return;
  open_ = false;
  ModelInterval& i = interval_;
  i.duration_s = end_s - i.start_s;
  if (i.duration_s < kSameChange_s - kRounding_s) return;
  if (i.settled) {
    const auto n = static_cast<double>(settled_.rows);
    i.bias_kg = settled_.error_kg / n;
    i.rmse_kg = std::sqrt(settled_.error_kg2 / n);
    i.com_x_rmse_m = std::sqrt(settled_.com_x_m2 / n);
    i.com_y_rmse_m = std::sqrt(settled_.com_y_m2 / n);
  } else {
    i.settling_s = end_s - change_s_;
  }
  if (late_.rows > 0) {
    const auto n = static_cast<double>(late_.rows);
    i.late_rows = late_.rows;
    i.late_bias_kg = late_.error_kg / n;
    i.late_com_x_bias_m = late_.com_x_m / n;
    i.late_com_y_bias_m = late_.com_y_m / n;
    const auto deviation = [n](double squares, double mean) {
      return std::sqrt(std::max(0.0, squares / n - mean * mean));
    };
    i.late_noise_kg = deviation(late_.error_kg2, i.late_bias_kg);
    i.late_com_x_noise_m = deviation(late_.com_x_m2, i.late_com_x_bias_m);
    i.late_com_y_noise_m = deviation(late_.com_y_m2, i.late_com_y_bias_m);
  }
  const bool of_all = !i.settled || settled_.used_rows == 0;
  i.used_rows = of_all ? all_used_rows_ : settled_.used_rows;
  const double used_kg = of_all ? all_used_kg_ : settled_.used_kg;
  if (i.used_rows > 0) i.used_bias_kg = used_kg / static_cast<double>(i.used_rows);
  metrics_.intervals.push_back(i);
}

ModelMetrics ModelAccumulator::Finish() {
  Close(last_s_);
  return metrics_;
}

// With default: results from before the late values are read, too.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(ModelInterval, start_s, duration_s, mass_kg,
                                                step_kg, settling_s, settled, rows, bias_kg,
                                                rmse_kg, com_x_rmse_m, com_y_rmse_m, late_rows,
                                                late_bias_kg, late_noise_kg, late_com_x_bias_m,
                                                late_com_y_bias_m, late_com_x_noise_m,
                                                late_com_y_noise_m, used_rows, used_bias_kg)

void to_json(nlohmann::json& j, const ModelMetrics& m) {
  j = {{"present", m.present}, {"intervals", m.intervals}};
}

void from_json(const nlohmann::json& j, ModelMetrics& m) {
  j.at("present").get_to(m.present);
  j.at("intervals").get_to(m.intervals);
}

}  // namespace scoria::analysis
