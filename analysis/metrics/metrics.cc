// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/metrics.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace scoria::analysis {
namespace {

constexpr double kChord_s = 0.5;
constexpr double kWindow_s = 5.0;
constexpr double kSettle_s = 3.0;      // after the command changed, a placement or a fallback
constexpr double kBeforeFall_s = 1.0;  // the tumble is no steady walking
// A command that differs by less than this and this share of the speed is the same: steering along
// a route.
constexpr double kSameCommand_mps = 0.05, kSameShare = 0.15;
constexpr double kStride_s = 0.5;  // averaging time where the log names no period

double CommandSpeed(const logs::LogRow& row) {
  return std::hypot(row.cmd_v_x_mps, row.cmd_v_y_mps);
}

bool IsStop(const logs::LogRow& row) {
  return row.cmd_v_x_mps == 0.0 && row.cmd_v_y_mps == 0.0 && row.cmd_w_z_radps == 0.0;
}

double SpeedMargin(double speed_mps) { return kSameCommand_mps + kSameShare * speed_mps; }

bool OnFallback(const logs::LogRow& row) {
  return std::any_of(row.fallen_back.begin(), row.fallen_back.end(), [](bool on) { return on; });
}

/// Against the command at the start of the steady stretch, so that slow drifts count too; the small
/// corrections of somebody who steers along a route do not.
bool SameCommand(const logs::LogRow& a, const logs::LogRow& b) {
  constexpr double kSameYaw_radps = 0.6;
  const double margin_mps = SpeedMargin(std::max(CommandSpeed(a), CommandSpeed(b)));
  return std::abs(a.cmd_v_x_mps - b.cmd_v_x_mps) < margin_mps &&
         std::abs(a.cmd_v_y_mps - b.cmd_v_y_mps) < margin_mps &&
         std::abs(a.cmd_w_z_radps - b.cmd_w_z_radps) < kSameYaw_radps && IsStop(a) == IsStop(b);
}

}  // namespace

void TimeHistogram::Add(double time_s) {
  const double bin = std::log(time_s / kShortest_s) / kWidth;
  ++counts_[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))];
  longest_s_ = std::max(longest_s_, time_s);
  ++count_;
}

TimeQuantiles TimeHistogram::Summarise() const {
  TimeQuantiles q{0.0, 0.0, longest_s_, static_cast<int>(count_)};
  if (count_ == 0) return q;
  const auto at = [&](double share) {
    const auto rank = static_cast<long>(share * static_cast<double>(count_ - 1));
    long below = 0;
    std::size_t bin = 0;
    while (below + counts_[bin] <= rank) below += counts_[bin++];
    const double middle_s = kShortest_s * std::exp((static_cast<double>(bin) + 0.5) * kWidth);
    return std::min(middle_s, longest_s_);
  };
  q.median_s = at(0.5);
  q.p99_s = at(0.99);
  return q;
}

MetricsAccumulator::Mark MetricsAccumulator::MarkOf(const logs::LogRow& row) {
  return {row.time_s,
          row.p_WB_m[0],
          row.p_WB_m[1],
          {row.mech_abs_J, row.mech_pos_J, row.electrical_J, row.battery_J}};
}

void MetricsAccumulator::StartStretch(const logs::LogRow& row) {
  in_stretch_ = true;
  segment_ = row.segment;
  chord_ = MarkOf(row);
  chord_mass_kgs_ = 0.0;
  last_window_s_ = -1.0;
  StartSteady(row);
  previous_ = row;
}

void MetricsAccumulator::StartSteady(const logs::LogRow& row) {
  steady_ = row;
  stride_.clear();
  stride_head_ = 0;
  standing_ = false;
  settled_s_ = row.time_s + kSettle_s;
  StartWindow(row);
}

void MetricsAccumulator::StartWindow(const logs::LogRow& row) {
  window_ = MarkOf(row);
  window_distance_m_ = window_transport_J_ = window_command_m_ = 0.0;
}

/// Counts the open chord, where a fall or the end of the log cuts it short.
void MetricsAccumulator::EndStretch() {
  if (!in_stretch_) return;
  in_stretch_ = false;
  CloseChord(previous_);
}

/// The mass that was carried over the chord is its mean over time.
void MetricsAccumulator::CloseChord(const logs::LogRow& row) {
  const double chord_m = std::hypot(row.p_WB_m[0] - chord_.x_m, row.p_WB_m[1] - chord_.y_m);
  const double elapsed_s = row.time_s - chord_.time_s;
  const double mass_kg = elapsed_s > 0.0 ? chord_mass_kgs_ / elapsed_s : row.total_mass_kg;
  const double transport_J = mass_kg * gravity_mps2_ * chord_m;
  metrics_.distance_m += chord_m;
  metrics_.transport_J += transport_J;
  window_distance_m_ += chord_m;
  window_transport_J_ += transport_J;
  chord_ = MarkOf(row);
  chord_mass_kgs_ = 0.0;
}

void MetricsAccumulator::DropWindowBefore(double fall_s) {
  if (last_window_s_ < 0.0 || fall_s - last_window_s_ > kBeforeFall_s) return;
  metrics_.windows.pop_back();
  last_window_s_ = -1.0;
}

/// Adds what the ledger says at the end of a stretch between placements.
void MetricsAccumulator::CloseBudget() {
  if (!has_rows_) return;
  EnergyBudget& b = metrics_.budget;
  const double stored_J = last_.kinetic_J + last_.potential_J - last_.initial_J;
  const double works_J =
      last_.work_motor_J + last_.work_joint_J + last_.work_contact_J + last_.work_external_J;
  b.motor_J += last_.work_motor_J;
  b.joint_J += last_.work_joint_J;
  b.contact_J += last_.work_contact_J;
  b.external_J += last_.work_external_J;
  b.stored_J += stored_J;
  b.error_J += std::abs(stored_J - works_J);
}

void MetricsAccumulator::AddRow(const logs::LogRow& row, const logs::SolveTimes& times) {
  estimation_.AddRow(row);
  model_.AddRow(row);
  if (has_rows_ && row.segment != last_.segment) CloseBudget();
  last_ = row;
  has_rows_ = true;
  metrics_.duration_s = row.time_s;
  metrics_.mass_kg = row.total_mass_kg;
  if (times.mpc_s > 0.0) mpc_times_.Add(times.mpc_s);
  if (times.wbc_s > 0.0) wbc_times_.Add(times.wbc_s);
  if (row.fallen && in_stretch_) DropWindowBefore(row.time_s);
  if (!row.operating || row.fallen || row.segment != segment_) EndStretch();
  if (!row.operating || row.fallen) return;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double* f = &row.f_F_W_N[3 * leg];
    metrics_.peak_foot_force_N =
        std::max(metrics_.peak_foot_force_N, std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
  }
  if (!in_stretch_) StartStretch(row);
  if (!SameCommand(row, steady_)) StartSteady(row);
  AddWalking(row);
  AddWindow(row);
  AddTracking(row);
  previous_ = row;
}

void MetricsAccumulator::AddWalking(const logs::LogRow& row) {
  metrics_.walking_s += row.time_s - previous_.time_s;
  metrics_.energy.mech_abs_J += row.mech_abs_J - previous_.mech_abs_J;
  metrics_.energy.mech_pos_J += row.mech_pos_J - previous_.mech_pos_J;
  metrics_.energy.electrical_J += row.electrical_J - previous_.electrical_J;
  metrics_.energy.battery_J += row.battery_J - previous_.battery_J;
  chord_mass_kgs_ += row.total_mass_kg * (row.time_s - previous_.time_s);
  if (row.time_s - chord_.time_s >= kChord_s - 1e-9) CloseChord(row);
}

/// One point of cost of transport against speed for every five steady seconds.
void MetricsAccumulator::AddWindow(const logs::LogRow& row) {
  if (OnFallback(row)) settled_s_ = row.time_s + kSettle_s;
  if (row.time_s < settled_s_ || CommandSpeed(row) == 0.0) {
    StartWindow(row);
    return;
  }
  window_command_m_ += CommandSpeed(row) * (row.time_s - previous_.time_s);
  const double elapsed_s = row.time_s - window_.time_s;
  if (elapsed_s < kWindow_s - 1e-9) return;
  const double v_mps = window_distance_m_ / elapsed_s, asked_mps = window_command_m_ / elapsed_s;
  if (std::abs(v_mps - asked_mps) < SpeedMargin(asked_mps) && window_transport_J_ > 0.0) {
    const double work_J = window_transport_J_;
    metrics_.windows.push_back({v_mps, asked_mps,
                                (row.mech_abs_J - window_.energy.mech_abs_J) / work_J,
                                (row.mech_pos_J - window_.energy.mech_pos_J) / work_J,
                                (row.electrical_J - window_.energy.electrical_J) / work_J});
    last_window_s_ = row.time_s;
  }
  StartWindow(row);
}

void MetricsAccumulator::AddTracking(const logs::LogRow& row) {
  if (row.time_s - steady_.time_s < kSettle_s) return;
  TrackingErrors& t = metrics_.tracking;
  if (IsStop(row)) {
    if (!standing_) {
      standing_ = true;
      stand_x_m_ = row.p_WB_m[0];
      stand_y_m_ = row.p_WB_m[1];
    }
    t.drift_m =
        std::max(t.drift_m, std::hypot(row.p_WB_m[0] - stand_x_m_, row.p_WB_m[1] - stand_y_m_));
  }
  const double yaw = row.rpy_rad[2], c = std::cos(yaw), s = std::sin(yaw);
  const double v_x = c * row.v_WB_mps[0] + s * row.v_WB_mps[1];
  const double v_y = -s * row.v_WB_mps[0] + c * row.v_WB_mps[1];
  t.velocity_x_mps += v_x;
  t.velocity_y_mps += v_y;
  t.yaw_rate_radps += row.w_WB_radps[2];
  t.command_x_mps += row.cmd_v_x_mps;
  t.command_y_mps += row.cmd_v_y_mps;
  t.command_yaw_radps += row.cmd_w_z_radps;
  const auto squared = [](double x) { return x * x; };
  // The reference lives in the estimator's frame; its drift is no error of tracking.
  sum_height_ += squared(row.com_z_m + HeightDrift(row) - row.ref_p_WC_m[2]);
  sum_roll_ += squared(row.rpy_rad[0] - row.ref_rpy_rad[0]);
  sum_pitch_ += squared(row.rpy_rad[1] - row.ref_rpy_rad[1]);
  t.samples_s += row.time_s - previous_.time_s;
  ++rows_;

  stride_.push_back({row.time_s, v_x - row.cmd_v_x_mps, v_y - row.cmd_v_y_mps});
  const double stride_s = row.period_s > 0.0 ? row.period_s : kStride_s;
  bool full = false;
  while (row.time_s - stride_[stride_head_][0] > stride_s - 1e-9) {
    ++stride_head_;
    full = true;
  }
  if (!full) return;
  double e_x = 0.0, e_y = 0.0;
  const auto n = static_cast<double>(stride_.size() - stride_head_);
  for (std::size_t i = stride_head_; i < stride_.size(); ++i) {
    e_x += stride_[i][1] / n;
    e_y += stride_[i][2] / n;
  }
  sum_velocity_ += e_x * e_x + e_y * e_y;
  ++stride_rows_;
  if (stride_head_ > 4096) {
    stride_.erase(stride_.begin(), stride_.begin() + static_cast<std::ptrdiff_t>(stride_head_));
    stride_head_ = 0;
  }
}

EpisodeMetrics MetricsAccumulator::Finish() {
  // A fall that ends the episode has no row of its own.
  if (in_stretch_ && !metrics_.falls.empty()) DropWindowBefore(metrics_.falls.back().time_s);
  EndStretch();
  CloseBudget();
  EpisodeMetrics m = metrics_;
  if (m.distance_m > kLeastWay_m && m.transport_J > 0.0) {
    m.cot_mech_abs = m.energy.mech_abs_J / m.transport_J;
    m.cot_mech_pos = m.energy.mech_pos_J / m.transport_J;
    m.cot_electrical = m.energy.electrical_J / m.transport_J;
    m.cot_battery = m.energy.battery_J / m.transport_J;
  }
  TrackingErrors& t = m.tracking;
  if (rows_ > 0) {
    const auto n = static_cast<double>(rows_);
    for (double* mean : {&t.velocity_x_mps, &t.velocity_y_mps, &t.yaw_rate_radps, &t.command_x_mps,
                         &t.command_y_mps, &t.command_yaw_radps}) {
      *mean /= n;
    }
    t.height_rmse_m = std::sqrt(sum_height_ / n);
    t.roll_rmse_rad = std::sqrt(sum_roll_ / n);
    t.pitch_rmse_rad = std::sqrt(sum_pitch_ / n);
  }
  if (stride_rows_ > 0)
    t.velocity_rmse_mps = std::sqrt(sum_velocity_ / static_cast<double>(stride_rows_));
  m.mpc = mpc_times_.Summarise();
  m.wbc = wbc_times_.Summarise();
  m.estimation = estimation_.Finish();
  m.model = model_.Finish();
  return m;
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Energy, mech_abs_J, mech_pos_J, electrical_J, battery_J)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnergyBudget, motor_J, joint_J, contact_J, external_J, stored_J,
                                   error_J)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SpeedWindow, v_mps, command_mps, cot_mech_abs, cot_mech_pos,
                                   cot_electrical)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrackingErrors, samples_s, velocity_rmse_mps, velocity_x_mps,
                                   velocity_y_mps, yaw_rate_radps, command_x_mps, command_y_mps,
                                   command_yaw_radps, height_rmse_m, roll_rmse_rad, pitch_rmse_rad,
                                   drift_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimeQuantiles, median_s, p99_s, max_s, count)
void to_json(nlohmann::json& j, const FallEvent& f) {
  j = {{"time_s", f.time_s}, {"cause", f.cause}};
  if (f.p_WB) j["p_WB_m"] = {f.p_WB->x(), f.p_WB->y()};
}

void from_json(const nlohmann::json& j, FallEvent& f) {
  j.at("time_s").get_to(f.time_s);
  j.at("cause").get_to(f.cause);
  if (j.contains("p_WB_m"))
    f.p_WB = Vec2(j.at("p_WB_m").at(0).get<double>(), j.at("p_WB_m").at(1).get<double>());
}

void to_json(nlohmann::json& j, const EpisodeMetrics& m) {
  j = {{"duration_s", m.duration_s},
       {"walking_s", m.walking_s},
       {"distance_m", m.distance_m},
       {"mass_kg", m.mass_kg},
       {"transport_J", m.transport_J},
       {"energy", m.energy},
       {"cot_mech_abs", m.cot_mech_abs},
       {"cot_mech_pos", m.cot_mech_pos},
       {"cot_electrical", m.cot_electrical},
       {"cot_battery", m.cot_battery},
       {"budget", m.budget},
       {"windows", m.windows},
       {"tracking", m.tracking},
       {"mpc", m.mpc},
       {"wbc", m.wbc},
       {"falls", m.falls},
       {"peak_foot_force_N", m.peak_foot_force_N},
       {"estimation", m.estimation},
       {"model", m.model}};
}

void from_json(const nlohmann::json& j, EpisodeMetrics& m) {
  j.at("duration_s").get_to(m.duration_s);
  j.at("walking_s").get_to(m.walking_s);
  j.at("distance_m").get_to(m.distance_m);
  j.at("mass_kg").get_to(m.mass_kg);
  m.transport_J = j.value("transport_J", 0.0);  // not in older results
  j.at("energy").get_to(m.energy);
  j.at("cot_mech_abs").get_to(m.cot_mech_abs);
  j.at("cot_mech_pos").get_to(m.cot_mech_pos);
  j.at("cot_electrical").get_to(m.cot_electrical);
  j.at("cot_battery").get_to(m.cot_battery);
  j.at("budget").get_to(m.budget);
  j.at("windows").get_to(m.windows);
  j.at("tracking").get_to(m.tracking);
  j.at("mpc").get_to(m.mpc);
  j.at("wbc").get_to(m.wbc);
  j.at("falls").get_to(m.falls);
  j.at("peak_foot_force_N").get_to(m.peak_foot_force_N);
  m.estimation = j.value("estimation", EstimationMetrics{});  // not in older results
  m.model = j.value("model", ModelMetrics{});
}

}  // namespace scoria::analysis
