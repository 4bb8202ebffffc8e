// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/metrics.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {
namespace {

constexpr double kBeforeFall_s = 1.0;  // the tumble is no steady walking

Energy ToEnergy(const logs::EnergyRow& e) {
  return {e.mech_abs_J, e.mech_pos_J, e.electrical_J, e.battery_J};
}

/// Without what stands in for the truth. When the robot walked is still known.
logs::Row WithoutTruth(logs::Row row, const logs::RowGroups& stand_ins) {
  logs::ForEachGroup(row, [&]<class Group>(std::optional<Group>& group) {
    const bool stands_in = stand_ins[static_cast<std::size_t>(Group::kGroup)];
    if (stands_in && logs::IsTruth(Group::kGroup)) group.reset();
  });
  return row;
}

bool OnFallback(const logs::Row& row) {
  if (!row.supervision) return false;
  const auto& on = row.supervision->fallen_back;
  return std::find(on.begin(), on.end(), true) != on.end();
}

}  // namespace

MetricsAccumulator::MetricsAccumulator(double gravity_mps2, const Metrics& metrics)
    : gravity_mps2_(gravity_mps2) {
  for (const Metric& m : metrics) {
    if (m.make != nullptr)
      own_.push_back({std::string(m.info.key), m.info.needs, m.info.takes_substitutes, m.make()});
  }
}

void MetricsAccumulator::AddRow(const logs::Row& row, const logs::RowGroups& stand_ins) {
  groups_ |= logs::GroupsOf(row) & ~stand_ins;
  AddOwn(row, true);
  if (stand_ins.none()) {
    AddOwn(row, false);
    estimation_.AddRow(row);
    model_.AddRow(row);
  } else {
    const logs::Row bare = WithoutTruth(row, stand_ins);
    AddOwn(bare, false);
    estimation_.AddRow(bare);
    model_.AddRow(bare);
  }
  metrics_.duration_s = row.time_s;
  if (row.true_mass) metrics_.mass_kg = row.true_mass->mass_kg;
  if (row.solve_times) AddTimes(*row.solve_times);
  if (row.episode) AddEpisode(row);
}

/// Shows the row to the metrics that take stand-ins, or to the others.
void MetricsAccumulator::AddOwn(const logs::Row& row, bool with_stand_ins) {
  const logs::RowGroups groups = logs::GroupsOf(row);
  for (Own& own : own_) {
    if (own.takes_substitutes == with_stand_ins && (own.needs & ~groups).none())
      own.accumulator->AddRow(row);
  }
}

void MetricsAccumulator::AddEpisode(const logs::Row& row) {
  const logs::EpisodeRow& episode = *row.episode;
  if (last_segment_ && episode.segment != *last_segment_) CloseBudget();
  last_segment_ = episode.segment;
  ledger_ = row.ledger;
  if (episode.fallen && in_stretch_) DropWindowBefore(row.time_s);
  const bool walking = episode.operating && !episode.fallen;
  if (!walking || episode.segment != segment_) EndStretch();
  if (episode.fallen) NoteFirstFall();
  if (!walking) return;
  if (row.true_contacts) {
    AddPeakForce(*row.true_contacts);
    gait_.Add(row.time_s, row.true_contacts->contact);
  }
  AddWalking(row);
}

void MetricsAccumulator::AddTimes(const logs::SolveTimesRow& times) {
  if (times.mpc_s) mpc_times_.Add(*times.mpc_s);
  if (times.wbc_s) wbc_times_.Add(*times.wbc_s);
}

void MetricsAccumulator::AddPeakForce(const logs::TrueContactsRow& contacts) {
  if (!contacts.f_F_W_N) return;
  double peak_N = metrics_.peak_foot_force_N.value_or(0.0);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const double* f = &(*contacts.f_F_W_N)[3 * leg];
    peak_N = std::max(peak_N, std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
  }
  metrics_.peak_foot_force_N = peak_N;
}

void MetricsAccumulator::AddWalking(const logs::Row& row) {
  if (!in_stretch_) StartStretch(row);
  const double dt_s = row.time_s - last_s_;
  metrics_.walking_s += dt_s;
  if (row.command && command_.Update(row.time_s, *row.command)) StartSteady(row);
  if (row.energy) AddEnergy(*row.energy);
  if (row.true_mass) {
    chord_mass_kgs_ += row.true_mass->mass_kg * dt_s;
    last_mass_kg_ = row.true_mass->mass_kg;
  }
  if (row.truth) AddPath(row);
  if (row.truth && row.true_mass && row.energy && row.command) AddWindow(row, dt_s);
  if (row.truth && row.command && command_.IsSettled(row.time_s)) tracking_.AddSteady(row, dt_s);
  last_s_ = row.time_s;
}

void MetricsAccumulator::StartStretch(const logs::Row& row) {
  in_stretch_ = true;
  segment_ = row.episode->segment;
  last_s_ = chord_start_s_ = row.time_s;
  last_energy_.reset();
  last_place_.reset();
  last_mass_kg_.reset();
  last_window_s_.reset();
  chord_mass_kgs_ = 0.0;
  command_.Restart();
}

void MetricsAccumulator::StartSteady(const logs::Row& row) {
  tracking_.BeginCommand();
  windows_.Restart(row.time_s);
  StartWindow(row);
}

void MetricsAccumulator::StartWindow(const logs::Row& row) {
  window_energy_ = row.energy ? std::optional(ToEnergy(*row.energy)) : std::nullopt;
  window_transport_J_ = 0.0;
}

/// Counts the open chord, where a fall or the end of the log cuts it short.
void MetricsAccumulator::EndStretch() {
  if (!in_stretch_) return;
  in_stretch_ = false;
  gait_.Break();
  if (last_place_) AddChord(path_.CloseChord(last_place_->p_W), last_place_->time_s);
}

void MetricsAccumulator::AddEnergy(const logs::EnergyRow& energy) {
  const Energy now = ToEnergy(energy);
  if (last_energy_) metrics_.energy += now - *last_energy_;
  last_energy_ = now;
}

void MetricsAccumulator::AddPath(const logs::Row& row) {
  const Place now{row.time_s, {row.truth->p_WB_m[0], row.truth->p_WB_m[1]}};
  const double dt_s = last_place_ ? now.time_s - last_place_->time_s : 0.0;
  last_place_ = now;
  if (const auto chord_m = path_.Add({dt_s, now.p_W})) AddChord(*chord_m, now.time_s);
}

/// The mass that was carried over a chord that ends is its mean over time.
void MetricsAccumulator::AddChord(double chord_m, double end_s) {
  metrics_.distance_m += chord_m;
  windows_.AddWay(chord_m);
  if (last_mass_kg_) {
    const double elapsed_s = end_s - chord_start_s_;
    const double mass_kg = elapsed_s > 0.0 ? chord_mass_kgs_ / elapsed_s : *last_mass_kg_;
    const double transport_J = mass_kg * gravity_mps2_ * chord_m;
    metrics_.transport_J += transport_J;
    window_transport_J_ += transport_J;
  }
  chord_start_s_ = end_s;
  chord_mass_kgs_ = 0.0;
}

void MetricsAccumulator::NoteFirstFall() {
  if (!metrics_.first_fall_m) metrics_.first_fall_m = metrics_.distance_m;
}

void MetricsAccumulator::DropWindowBefore(double fall_s) {
  if (!last_window_s_ || fall_s - *last_window_s_ > kBeforeFall_s) return;
  metrics_.windows.pop_back();
  last_window_s_.reset();
}

/// Adds what the ledger says at the end of a stretch between placements.
void MetricsAccumulator::CloseBudget() {
  if (!ledger_) return;
  const double stored_J = ledger_->kinetic_J + ledger_->potential_J - ledger_->initial_J;
  const double works_J =
      ledger_->motor_J + ledger_->joint_J + ledger_->contact_J + ledger_->external_J;
  metrics_.budget += {ledger_->motor_J,    ledger_->joint_J, ledger_->contact_J,
                      ledger_->external_J, stored_J,         std::abs(stored_J - works_J)};
}

/// One point of cost of transport against speed for every five steady seconds.
void MetricsAccumulator::AddWindow(const logs::Row& row, double dt_s) {
  const SteadyWindows::Step step =
      windows_.Add({row.time_s, dt_s, SpeedOf(*row.command), OnFallback(row)});
  if (step.ended && window_energy_ && window_transport_J_ > 0.0) {
    const double work_J = window_transport_J_;
    const Energy used = ToEnergy(*row.energy) - *window_energy_;
    metrics_.windows.push_back({step.ended->v_mps, step.ended->command_mps,
                                used.mech_abs_J / work_J, used.mech_pos_J / work_J,
                                used.electrical_J / work_J});
    last_window_s_ = row.time_s;
  }
  if (step.begins) StartWindow(row);
}

EpisodeMetrics MetricsAccumulator::Finish() {
  // A fall that ends the episode has no row of its own.
  if (in_stretch_ && !metrics_.falls.empty()) DropWindowBefore(metrics_.falls.back().time_s);
  EndStretch();
  if (!metrics_.falls.empty()) NoteFirstFall();
  CloseBudget();
  EpisodeMetrics m = metrics_;
  m.groups = groups_;
  m.cot = CalcCostOfTransport(m);
  m.tracking = tracking_.Result();
  m.mpc = mpc_times_.Summarise();
  m.wbc = wbc_times_.Summarise();
  m.estimation = estimation_.Finish();
  m.model = model_.Finish();
  m.gait = gait_.timing();
  for (const Own& own : own_) {
    if (const auto value = own.accumulator->Value()) m.measured[own.key] = *value;
  }
  return m;
}

}  // namespace scoria::analysis
