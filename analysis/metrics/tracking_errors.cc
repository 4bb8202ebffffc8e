// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/tracking_errors.h"

#include <algorithm>
#include <cmath>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/signals/steady.h"

namespace scoria::analysis {
namespace {

constexpr double kStride_s = 0.5;  // averaging time where the log names no period

}  // namespace

void TrackingAccumulator::MeanSquare::Add(double error) noexcept {
  sum += error * error;
  ++count;
}

std::optional<double> TrackingAccumulator::MeanSquare::Root() const noexcept {
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(count));
}

void TrackingAccumulator::BeginCommand() noexcept {
  stride_.Reset();
  stand_W_.reset();
}

void TrackingAccumulator::AddStanding(const Vec2& p_W) noexcept {
  if (!stand_W_) stand_W_ = p_W;
  sums_.drift_m = std::max(sums_.drift_m.value_or(0.0), (p_W - *stand_W_).norm());
}

void TrackingAccumulator::AddReference(const logs::Row& row) noexcept {
  // The reference lives in the estimator's frame; its drift is no error of tracking.
  if (row.true_mass)
    height_.Add(row.true_mass->p_WC_z_m + HeightDrift(row).value_or(0.0) -
                row.reference->p_WC_m[2]);
  roll_.Add(row.truth->rpy_rad[0] - row.reference->rpy_rad[0]);
  pitch_.Add(row.truth->rpy_rad[1] - row.reference->rpy_rad[1]);
}

void TrackingAccumulator::AddSteady(const logs::Row& row, double dt_s) {
  TrackingErrors& t = sums_;
  const logs::CommandRow& command = *row.command;
  if (IsStop(command)) AddStanding({row.truth->p_WB_m[0], row.truth->p_WB_m[1]});
  const double yaw = row.truth->rpy_rad[2], c = std::cos(yaw), s = std::sin(yaw);
  const double v_x = c * row.truth->v_WB_mps[0] + s * row.truth->v_WB_mps[1];
  const double v_y = -s * row.truth->v_WB_mps[0] + c * row.truth->v_WB_mps[1];
  t.velocity_x_mps += v_x;
  t.velocity_y_mps += v_y;
  t.yaw_rate_radps += row.truth->w_WB_radps[2];
  t.command_x_mps += command.v_x_mps;
  t.command_y_mps += command.v_y_mps;
  t.command_yaw_radps += command.w_z_radps;
  t.samples_s += dt_s;
  ++rows_;
  if (row.reference) AddReference(row);
  const double stride_s = row.plan && row.plan->period_s > 0.0 ? row.plan->period_s : kStride_s;
  const Vec2 error(v_x - command.v_x_mps, v_y - command.v_y_mps);
  if (const auto mean = stride_.Add(row.time_s, error, stride_s)) velocity_.Add(mean->norm());
}

TrackingErrors TrackingAccumulator::Result() const noexcept {
  TrackingErrors t = sums_;
  if (rows_ > 0) {
    const auto n = static_cast<double>(rows_);
    for (double* mean : {&t.velocity_x_mps, &t.velocity_y_mps, &t.yaw_rate_radps, &t.command_x_mps,
                         &t.command_y_mps, &t.command_yaw_radps}) {
      *mean /= n;
    }
  }
  t.velocity_rmse_mps = velocity_.Root();
  t.height_rmse_m = height_.Root();
  t.roll_rmse_rad = roll_.Root();
  t.pitch_rmse_rad = pitch_.Root();
  return t;
}

}  // namespace scoria::analysis
