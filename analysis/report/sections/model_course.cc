// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/model_course.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analysis/metrics/model_metrics.h"
#include "analysis/plots/course_plot.h"
#include "core/files.h"

namespace scoria::analysis {
namespace {

/// Columns over the rows, NaN where nothing was learned.
struct ModelColumns {
  std::vector<double> time_s;
  std::vector<double> learned_kg, low_kg, high_kg, used_kg, true_kg;
  std::vector<double> learned_x_mm, true_x_mm, learned_y_mm, true_y_mm;

  void Add(const logs::Row& r) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const logs::LearnedModel kUnknown{kNan, std::nullopt, {kNan, kNan, kNan}};
    const bool operating = r.episode && r.episode->operating;
    const logs::LearnedModel* found =
        operating && !r.episode->fallen ? FindLearnedModel(r) : nullptr;
    const logs::LearnedModel& learned = found != nullptr ? *found : kUnknown;
    const logs::TrueMassRow truth =
        r.true_mass.value_or(logs::TrueMassRow{kNan, {kNan, kNan, kNan}, kNan});
    time_s.push_back(r.time_s);
    learned_kg.push_back(learned.mass_kg);
    const double sigma_kg = learned.sigma_kg.value_or(kNan);
    low_kg.push_back(learned.mass_kg - sigma_kg);
    high_kg.push_back(learned.mass_kg + sigma_kg);
    used_kg.push_back(operating && r.model ? r.model->used_mass_kg : kNan);
    true_kg.push_back(truth.mass_kg);
    learned_x_mm.push_back(1e3 * learned.p_BC_m[0]);
    true_x_mm.push_back(1e3 * truth.p_BC_m[0]);
    learned_y_mm.push_back(1e3 * learned.p_BC_m[1]);
    true_y_mm.push_back(1e3 * truth.p_BC_m[1]);
  }
};

/// Stretches of constant mass above the smallest: gradual changes stay white.
std::vector<std::pair<double, double>> LoadedStretches(const ModelColumns& c) {
  constexpr double kLeastPayload_kg = 0.01, kLeast_s = 0.1;
  std::vector<std::pair<double, double>> stretches;
  if (c.time_s.empty()) return stretches;
  double base_kg = std::numeric_limits<double>::infinity();
  for (const double mass_kg : c.true_kg) base_kg = std::fmin(base_kg, mass_kg);  // NaN: unknown
  const std::size_t n = c.time_s.size();
  std::size_t start = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    if (i < n && c.true_kg[i] == c.true_kg[start]) continue;
    const double end_s = i < n ? c.time_s[i] : c.time_s.back();
    const bool loaded = c.true_kg[start] > base_kg + kLeastPayload_kg;
    if (loaded && end_s - c.time_s[start] >= kLeast_s)
      stretches.emplace_back(c.time_s[start], end_s);
    start = i;
  }
  return stretches;
}

}  // namespace

CaptionedFigure ModelCourse(const logs::LogContent& log, const std::string& name) {
  ModelColumns c;
  for (const logs::Row& row : log.rows) c.Add(row);
  CoursePlot plot;
  plot.name = "model_" + core::FileNameOf(name);
  plot.title = "Learned mass of " + name;
  plot.stretches_s = LoadedStretches(c);
  const char* const truth = Palette::kBlack;
  plot.panels = {
      {.y_label = "mass [kg]",
       .bands = {{"±1 sigma", c.low_kg, c.high_kg, Palette::kBlue}},
       .lines = {{"true", c.true_kg, truth},
                 {"learned", c.learned_kg, Palette::kBlue},
                 {"acted on", c.used_kg, Palette::kVermilion, true}}},
      {.y_label = "COM x [mm]",
       .lines = {{"true", c.true_x_mm, truth}, {"learned", c.learned_x_mm, Palette::kGreen}}},
      {.y_label = "COM y [mm]",
       .lines = {{"true", c.true_y_mm, truth}, {"learned", c.learned_y_mm, Palette::kPurple}}}};
  plot.time_s = std::move(c.time_s);
  return {DrawCourse(plot),
          "Mass of the whole robot and its centre of mass in the trunk's frame. Grey: the robot "
          "carries a payload. Learned values are shown from when the readings at the known mass "
          "were taken; acted on: by gait, MPC and whole-body control."};
}

}  // namespace scoria::analysis
