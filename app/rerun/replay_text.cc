// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay_text.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/math/angles.h"

namespace scoria::app {
namespace {

using nlohmann::json;

constexpr double kMmPerM = 1e3, kMsPerS = 1e3, kPercent = 100.0;

using Number = std::optional<double>;

/// A line of the table. `of` has no value where the log cannot give one.
struct Score {
  const char* name;
  const char* unit;
  int digits;
  std::function<Number(const analysis::EstimationMetrics&)> of = nullptr;  // one of the three
  std::function<Number(const VariantResult&)> of_variant = nullptr;        // not of the log's own
  std::function<Number(const analysis::TrajectoryError&)> of_trajectory = nullptr;
};

Number If(bool known, double value) { return known ? Number(value) : std::nullopt; }

/// Of segments of any length: a field log is short.
Number Drift(const analysis::EstimationMetrics& m, double analysis::DriftSummary::*field) {
  const analysis::DriftSummary drift = analysis::SummariseDrift(m);
  return If(drift.segments > 0 && m.rows > 0, drift.*field);
}

const analysis::ContactQuality& Fused(const analysis::EstimationMetrics& m) {
  return m.contact.of(analysis::ContactDetector::kFused);
}

std::vector<Score> Scores() {
  using M = analysis::EstimationMetrics;
  using V = VariantResult;
  using T = analysis::TrajectoryError;
  using D = analysis::DriftSummary;
  return {
      {"drift, horizontal", "% of way", 2, [](const M& m) { return Drift(m, &D::horizontal_pct); }},
      {"drift, vertical", "% of way", 2, [](const M& m) { return Drift(m, &D::vertical_pct); }},
      {"drift, yaw", "deg/m", 3, [](const M& m) { return Drift(m, &D::yaw_deg_per_m); }},
      {"absolute error", "mm", 1, nullptr, nullptr,
       [](const T& e) { return If(e.stretches > 0, kMmPerM * e.ate_m); }},
      {"relative error, 1 m", "mm", 1,
       [](const M& m) { return If(m.rpe_1m.stretches > 0, kMmPerM * m.rpe_1m.horizontal_rms_m); }},
      {"velocity error", "m/s", 4, [](const M& m) { return If(m.rows > 0, m.velocity_rmse_mps); }},
      {"roll error", "deg", 3,
       [](const M& m) { return If(m.rows > 0, core::kDegreesPerRad * m.roll_rmse_rad); }},
      {"pitch error", "deg", 3,
       [](const M& m) { return If(m.rows > 0, core::kDegreesPerRad * m.pitch_rmse_rad); }},
      {"NEES over its freedoms", "", 2,
       [](const M& m) { return If(m.nees_rows > 0, m.nees_ratio); }},
      {"NIS over its freedoms", "", 2, [](const M& m) { return If(m.nis_dof > 0, m.nis_ratio); }},
      {"contacts right", "%", 2,
       [](const M& m) { return If(m.contact.HasDetection(), kPercent * Fused(m).Accuracy()); }},
      {"touchdown found after", "ms", 1,
       [](const M& m) {
         const analysis::DelayHistogram& delays = Fused(m).touchdown.delays;
         return If(m.contact.HasDetection() && delays.count() > 0, kMsPerS * delays.Quantile(0.5));
       }},
      {"standing feet's speed", "m/s", 4, nullptr,
       [](const V& v) {
         return If(v.consistency.stance_samples > 0, v.consistency.stance_speed_rms_mps);
       }},
      {"footholds off a plane", "mm", 1, nullptr,
       [](const V& v) {
         return If(v.consistency.footholds > 0, kMmPerM * v.consistency.plane_rms_m);
       }},
      {"way", "m", 2, nullptr, [](const V& v) { return Number(v.consistency.path_m); }},
      {"end from start", "m", 3, nullptr,
       [](const V& v) { return Number(v.consistency.closure_m); }},
      {"learned mass", "kg", 2, nullptr,
       [](const V& v) { return v.mass ? Number(v.mass->mass_kg) : std::nullopt; }},
      {"  its deviation", "kg", 2, nullptr,
       [](const V& v) { return v.mass ? Number(v.mass->sigma_kg) : std::nullopt; }},
      {"feet carry", "kg", 2, nullptr, [](const V& v) { return v.feet_carry_kg; }},
      {"gaps", "", 0, nullptr, [](const V& v) { return Number(static_cast<double>(v.gaps)); }},
  };
}

Number Value(const Score& score, const VariantResult& v) {
  if (score.of_trajectory) return score.of_trajectory(v.trajectory);
  return score.of ? score.of(v.estimation) : score.of_variant(v);
}

Number LoggedValue(const Score& score, const ReplayReport& report) {
  if (!report.logged) return std::nullopt;
  if (score.of_trajectory) return score.of_trajectory(*report.logged_trajectory);
  return score.of ? score.of(*report.logged) : std::nullopt;
}

std::string Cell(const Score& score, const Number& value) {
  return value ? fmt::format("{:.{}f}", *value, score.digits) : "-";
}

std::string DescribeInputs(const ReplayReport& report) {
  const LogInputs& in = report.inputs;
  std::string held;
  const auto say = [&](bool has, const char* what) {
    if (has) held += fmt::format("{}{}", held.empty() ? "" : ", ", what);
  };
  say(in.joints, "joints");
  say(in.torques, "torques");
  say(in.gyroscope, "gyroscope");
  say(in.accelerometer, "accelerometer");
  say(in.foot_forces, "foot forces");
  say(in.plan, "gait plan");
  say(in.truth, in.truth_is_of_markers ? "truth of markers" : "truth");
  say(in.true_contacts, "true contacts");
  const std::string alignment =
      in.alignment ? analysis::DescribeAlignment(*in.alignment) + "\n" : "";
  return fmt::format("{} rows at {:.1f} Hz, {:.1f} s; robot {}{}\nholds {}\n{}", in.rows,
                     1.0 / in.period_s, in.last_s - in.first_s, in.robot.config.name,
                     in.mapping.empty() ? "" : ", mapping " + in.mapping, held, alignment);
}

std::string DescribeRemarks(const VariantResult& v) {
  std::string text;
  for (const std::string& remark : v.remarks) text += fmt::format("{}: {}\n", v.name, remark);
  if (v.started_in_motion)
    text += fmt::format("{}: the log begins in motion: the start is unsure\n", v.name);
  if (v.trajectory.stretches == 0 && v.groups[static_cast<std::size_t>(logs::RowGroup::kTruth)])
    text += fmt::format("{}: {}\n", v.name, v.trajectory.Refusal());
  if (v.gaps > 0)
    text += fmt::format("{}: {} gaps, after each a new start of the way, unsure\n", v.name, v.gaps);
  if (v.mass && !v.mass->tared)
    text += fmt::format("{}: the mass was never tared within the log\n", v.name);
  return text;
}

}  // namespace

std::string DescribeReplay(const ReplayReport& report) {
  constexpr std::size_t kNameWidth = 24, kUnitWidth = 9;
  std::string text = DescribeInputs(report);
  std::vector<std::string> heads;
  if (report.logged) heads.emplace_back("logged");
  for (const VariantResult& v : report.variants) heads.push_back(v.name);
  text += fmt::format("\n{:{}}", "", kNameWidth + kUnitWidth);
  for (const std::string& head : heads) text += fmt::format(" {:>12}", head);
  text += '\n';
  for (const Score& score : Scores()) {
    std::vector<std::string> cells;
    if (report.logged) cells.push_back(Cell(score, LoggedValue(score, report)));
    for (const VariantResult& v : report.variants) cells.push_back(Cell(score, Value(score, v)));
    if (std::ranges::all_of(cells, [](const std::string& cell) { return cell == "-"; })) continue;
    text += fmt::format("{:{}}{:{}}", score.name, kNameWidth, score.unit, kUnitWidth);
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += fmt::format(" {:>{}}", cells[i], std::max<std::size_t>(12, heads[i].size()));
    text += '\n';
  }
  for (const VariantResult& v : report.variants) text += DescribeRemarks(v);
  return text;
}

json ReplayJson(const ReplayReport& report) {
  const auto scores = [](const auto& value_of) {
    json all = json::object();
    for (const Score& score : Scores()) {
      const Number value = value_of(score);
      std::string key = score.name;
      key.erase(0, key.find_first_not_of(' '));
      if (*score.unit != '\0') key += fmt::format(" [{}]", score.unit);
      all[key] = value ? json(*value) : json(nullptr);
    }
    return all;
  };
  json j = {{"rows", report.inputs.rows},
            {"period_s", report.inputs.period_s},
            {"duration_s", report.inputs.last_s - report.inputs.first_s},
            {"robot", report.inputs.robot.config.name},
            {"mapping", report.inputs.mapping},
            {"problem", report.inputs.problem}};
  if (report.logged)
    j["logged"] = scores([&](const Score& score) { return LoggedValue(score, report); });
  if (report.inputs.alignment) j["alignment"] = *report.inputs.alignment;
  for (const VariantResult& v : report.variants) {
    json one = {{"name", v.name},
                {"set", v.set},
                {"remarks", v.remarks},
                {"started_in_motion", v.started_in_motion},
                {"scores", scores([&](const Score& score) { return Value(score, v); })},
                {"trajectory", v.trajectory},
                {"estimation", v.estimation}};
    j["variants"].push_back(std::move(one));
  }
  return j;
}

}  // namespace scoria::app
