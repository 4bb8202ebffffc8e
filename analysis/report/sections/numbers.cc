// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string CostText(double cost) { return NumberText(When(cost > 0.0, cost), 2); }

std::string ErrorText(const Cell& c, double TrackingErrors::*error, double scale, int digits) {
  return NumberText(When(c.tracking.samples_s > 0.0, c.tracking.*error * scale), digits);
}

std::string TimesText(double median_s, double p99_s, int digits) {
  return NumberText(When(median_s > 0.0, median_s * 1e6), digits) + " / " +
         NumberText(When(p99_s > 0.0, p99_s * 1e6), digits);
}

constexpr std::array<Column<Cell>, 15> kColumns = {{
    {"metres", [](const Cell& c) { return NumberText(c.falls.exposure, 0); }},
    {"falls", [](const Cell& c) { return std::to_string(c.falls.events); }},
    {"stuck", [](const Cell& c) { return std::to_string(c.stuck); }},
    {"metres per fall", [](const Cell& c) { return MetresPerFall(c.falls); }},
    {"CoT mech_abs", [](const Cell& c) { return CostText(c.cot_mech_abs); }},
    {"CoT mech_pos", [](const Cell& c) { return CostText(c.cot_mech_pos); }},
    {"CoT electrical", [](const Cell& c) { return CostText(c.cot_electrical); }},
    {"CoT battery", [](const Cell& c) { return CostText(c.cot_battery); }},
    {"velocity RMSE [m/s]",
     [](const Cell& c) { return ErrorText(c, &TrackingErrors::velocity_rmse_mps, 1.0, 3); }},
    {"height RMSE [mm]",
     [](const Cell& c) { return ErrorText(c, &TrackingErrors::height_rmse_m, 1e3, 1); }},
    {"roll RMSE [deg]",
     [](const Cell& c) { return ErrorText(c, &TrackingErrors::roll_rmse_rad, kDegrees, 2); }},
    {"pitch RMSE [deg]",
     [](const Cell& c) { return ErrorText(c, &TrackingErrors::pitch_rmse_rad, kDegrees, 2); }},
    {"MPC median / p99 [µs]",
     [](const Cell& c) { return TimesText(c.mpc_median_s, c.mpc_p99_s, 0); }},
    {"WBC median / p99 [µs]",
     [](const Cell& c) { return TimesText(c.wbc_median_s, c.wbc_p99_s, 1); }},
    {"real-time factor", [](const Cell& c) { return NumberText(c.real_time_factor, 1); }},
}};

std::optional<std::string> WhyNot(const ReportInput& /*input*/) { return std::nullopt; }

Blocks Build(const ReportInput& input) {
  return {PointTable(input.results.axes, input.cells, kColumns)};
}

}  // namespace

Section NumbersSection() { return {"numbers", "Numbers", WhyNot, Build}; }

}  // namespace scoria::analysis
