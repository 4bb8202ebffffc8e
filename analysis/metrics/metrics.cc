// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/metrics.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace scoria::analysis {
namespace {

constexpr double kBeforeFall_s = 1.0;  // the tumble is no steady walking
constexpr double kStride_s = 0.5;      // averaging time where the log names no period

Vec2 HorizontalPlace(const logs::Row& row) { return {row.truth->p_WB_m[0], row.truth->p_WB_m[1]}; }

bool OnFallback(const logs::Row& row) {
  if (!row.supervision) return false;
  const auto& on = row.supervision->fallen_back;
  return std::find(on.begin(), on.end(), true) != on.end();
}

/// What the numbers of walking need.
bool IsWhole(const logs::Row& row) {
  return row.truth && row.true_mass && row.energy && row.command && row.reference;
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

Energy MetricsAccumulator::EnergyOf(const logs::Row& row) {
  const logs::EnergyRow& e = *row.energy;
  return {e.mech_abs_J, e.mech_pos_J, e.electrical_J, e.battery_J};
}

void MetricsAccumulator::StartStretch(const logs::Row& row) {
  in_stretch_ = true;
  segment_ = row.episode->segment;
  path_.Add({0.0, HorizontalPlace(row)});
  chord_start_s_ = row.time_s;
  chord_mass_kgs_ = 0.0;
  last_window_s_ = -1.0;
  command_.Restart();
  previous_ = row;
}

void MetricsAccumulator::StartSteady(const logs::Row& row) {
  stride_.Reset();
  stand_W_.reset();
  windows_.Restart(row.time_s);
  StartWindow(row);
}

void MetricsAccumulator::StartWindow(const logs::Row& row) {
  window_energy_ = EnergyOf(row);
  window_transport_J_ = 0.0;
}

/// Counts the open chord, where a fall or the end of the log cuts it short.
void MetricsAccumulator::EndStretch() {
  if (!in_stretch_) return;
  in_stretch_ = false;
  AddChord(path_.CloseChord(HorizontalPlace(previous_)), previous_);
}

/// The mass that was carried over a chord that ends is its mean over time.
void MetricsAccumulator::AddChord(double chord_m, const logs::Row& row) {
  const double elapsed_s = row.time_s - chord_start_s_;
  const double mass_kg = elapsed_s > 0.0 ? chord_mass_kgs_ / elapsed_s : row.true_mass->mass_kg;
  const double transport_J = mass_kg * gravity_mps2_ * chord_m;
  metrics_.distance_m += chord_m;
  metrics_.transport_J += transport_J;
  windows_.AddWay(chord_m);
  window_transport_J_ += transport_J;
  chord_start_s_ = row.time_s;
  chord_mass_kgs_ = 0.0;
}

void MetricsAccumulator::DropWindowBefore(double fall_s) {
  if (last_window_s_ < 0.0 || fall_s - last_window_s_ > kBeforeFall_s) return;
  metrics_.windows.pop_back();
  last_window_s_ = -1.0;
}

/// Adds what the ledger says at the end of a stretch between placements.
void MetricsAccumulator::CloseBudget() {
  if (!ledger_) return;
  EnergyBudget& b = metrics_.budget;
  const double stored_J = ledger_->kinetic_J + ledger_->potential_J - ledger_->initial_J;
  const double works_J =
      ledger_->motor_J + ledger_->joint_J + ledger_->contact_J + ledger_->external_J;
  b.motor_J += ledger_->motor_J;
  b.joint_J += ledger_->joint_J;
  b.contact_J += ledger_->contact_J;
  b.external_J += ledger_->external_J;
  b.stored_J += stored_J;
  b.error_J += std::abs(stored_J - works_J);
}

void MetricsAccumulator::AddTimes(const logs::SolveTimesRow& times) {
  if (times.mpc_s) mpc_times_.Add(*times.mpc_s);
  if (times.wbc_s) wbc_times_.Add(*times.wbc_s);
}

void MetricsAccumulator::AddRow(const logs::Row& row) {
  estimation_.AddRow(row);
  model_.AddRow(row);
  metrics_.duration_s = row.time_s;
  if (row.true_mass) metrics_.mass_kg = row.true_mass->mass_kg;
  if (row.solve_times) AddTimes(*row.solve_times);
  if (!row.episode) return;
  const logs::EpisodeRow& episode = *row.episode;
  if (last_segment_ && episode.segment != *last_segment_) CloseBudget();
  last_segment_ = episode.segment;
  ledger_ = row.ledger;
  if (episode.fallen && in_stretch_) DropWindowBefore(row.time_s);
  const bool walking = episode.operating && !episode.fallen;
  if (!walking || episode.segment != segment_) EndStretch();
  if (!walking) return;
  if (row.true_contacts) AddPeakForce(*row.true_contacts);
  if (IsWhole(row)) AddWhole(row);
}

void MetricsAccumulator::AddPeakForce(const logs::TrueContactsRow& contacts) {
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double* f = &contacts.f_F_W_N[3 * leg];
    metrics_.peak_foot_force_N =
        std::max(metrics_.peak_foot_force_N, std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
  }
}

void MetricsAccumulator::AddWhole(const logs::Row& row) {
  if (!in_stretch_) StartStretch(row);
  if (command_.Update(row.time_s, *row.command)) StartSteady(row);
  AddWalking(row);
  AddWindow(row);
  AddTracking(row);
  previous_ = row;
}

void MetricsAccumulator::AddWalking(const logs::Row& row) {
  metrics_.walking_s += row.time_s - previous_.time_s;
  metrics_.energy.mech_abs_J += row.energy->mech_abs_J - previous_.energy->mech_abs_J;
  metrics_.energy.mech_pos_J += row.energy->mech_pos_J - previous_.energy->mech_pos_J;
  metrics_.energy.electrical_J += row.energy->electrical_J - previous_.energy->electrical_J;
  metrics_.energy.battery_J += row.energy->battery_J - previous_.energy->battery_J;
  chord_mass_kgs_ += row.true_mass->mass_kg * (row.time_s - previous_.time_s);
  if (const auto chord_m = path_.Add({row.time_s - previous_.time_s, HorizontalPlace(row)}))
    AddChord(*chord_m, row);
}

/// One point of cost of transport against speed for every five steady seconds.
void MetricsAccumulator::AddWindow(const logs::Row& row) {
  const SteadyWindows::Step step = windows_.Add(
      {row.time_s, row.time_s - previous_.time_s, SpeedOf(*row.command), OnFallback(row)});
  if (step.ended && window_transport_J_ > 0.0) {
    const double work_J = window_transport_J_;
    const Energy now = EnergyOf(row);
    metrics_.windows.push_back({step.ended->v_mps, step.ended->command_mps,
                                (now.mech_abs_J - window_energy_.mech_abs_J) / work_J,
                                (now.mech_pos_J - window_energy_.mech_pos_J) / work_J,
                                (now.electrical_J - window_energy_.electrical_J) / work_J});
    last_window_s_ = row.time_s;
  }
  if (step.begins) StartWindow(row);
}

void MetricsAccumulator::AddTracking(const logs::Row& row) {
  if (!command_.IsSettled(row.time_s)) return;
  TrackingErrors& t = metrics_.tracking;
  const logs::CommandRow& command = *row.command;
  if (IsStop(command)) {
    if (!stand_W_) stand_W_ = HorizontalPlace(row);
    t.drift_m = std::max(t.drift_m, (HorizontalPlace(row) - *stand_W_).norm());
  }
  const double yaw = row.truth->rpy_rad[2], c = std::cos(yaw), s = std::sin(yaw);
  const double v_x = c * row.truth->v_WB_mps[0] + s * row.truth->v_WB_mps[1];
  const double v_y = -s * row.truth->v_WB_mps[0] + c * row.truth->v_WB_mps[1];
  t.velocity_x_mps += v_x;
  t.velocity_y_mps += v_y;
  t.yaw_rate_radps += row.truth->w_WB_radps[2];
  t.command_x_mps += command.v_x_mps;
  t.command_y_mps += command.v_y_mps;
  t.command_yaw_radps += command.w_z_radps;
  const auto squared = [](double x) { return x * x; };
  // The reference lives in the estimator's frame; its drift is no error of tracking.
  sum_height_ +=
      squared(row.true_mass->p_WC_z_m + HeightDrift(row).value_or(0.0) - row.reference->p_WC_m[2]);
  sum_roll_ += squared(row.truth->rpy_rad[0] - row.reference->rpy_rad[0]);
  sum_pitch_ += squared(row.truth->rpy_rad[1] - row.reference->rpy_rad[1]);
  t.samples_s += row.time_s - previous_.time_s;
  ++rows_;

  const double stride_s = row.plan && row.plan->period_s > 0.0 ? row.plan->period_s : kStride_s;
  const Vec2 error(v_x - command.v_x_mps, v_y - command.v_y_mps);
  if (const auto mean = stride_.Add(row.time_s, error, stride_s)) {
    sum_velocity_ += mean->squaredNorm();
    ++stride_rows_;
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
