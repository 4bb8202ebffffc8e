// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/field_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/field/leg_odometry.h"
#include "analysis/signals/steady.h"
#include "core/math/so3.h"
#include "logs/vectors.h"

namespace scoria::analysis {
namespace {

double NominalHeight(const core::RobotDescription* robot) {
  return robot != nullptr ? robot->config.nominal_height_m : 0.0;
}

}  // namespace

FieldRows::FieldRows(FieldSetup setup, OnRow on_row)
    : setup_(std::move(setup)),
      on_row_(std::move(on_row)),
      clues_(setup_.mass_kg ? setup_.robot : nullptr, setup_.mass_kg.value_or(0.0),
             setup_.gravity_mps2),
      detector_(setup_.falls, NominalHeight(setup_.robot)),
      posture_(NominalHeight(setup_.robot), setup_.gravity_mps2) {
  if (setup_.robot != nullptr) model_.emplace(*setup_.robot, setup_.gravity_mps2);
}

void FieldRows::Add(const logs::Row& row) {
  if (waiting_) Complete(std::move(*waiting_), &row);
  waiting_ = row;
}

void FieldRows::Finish() {
  if (waiting_) Complete(std::move(*waiting_), nullptr);
  waiting_.reset();
  smoother_.Finish();
  HandOnSmoothed();
}

/// The robot was set down elsewhere, or rows are missing.
bool FieldRows::IsNewPlace(const logs::Row& row) const {
  if (!last_.time_s) return false;
  const double dt_s = row.time_s - *last_.time_s;
  if (dt_s > setup_.gap_s || dt_s < 0.0) return true;
  constexpr double kJump_m = 0.05, kJump_mps = 5.0, kJump_rad = 0.3, kJump_radps = 40.0;
  if (last_.p_WB && row.estimate) {
    const Vec3 step = logs::ToVec3(row.estimate->p_WB_m) - *last_.p_WB;
    if ((step - dt_s * *last_.v_WB).norm() > kJump_m + kJump_mps * dt_s) return true;
  }
  if (!last_.q_rad || !row.measured || !row.measured->q_rad) return false;
  int jumps = 0;
  for (std::size_t k = 0; k < last_.q_rad->size(); ++k) {
    const double step_rad = std::abs((*row.measured->q_rad)[k] - (*last_.q_rad)[k]);
    if (step_rad > kJump_rad + kJump_radps * dt_s) ++jumps;
  }
  return jumps > 1;  // a single encoder may fail
}

bool FieldRows::IsUpright(const logs::Row& row) const {
  constexpr double kUpright = 0.87;  // cos 30 degrees
  const std::optional<Mat3> R_WB = AttitudeOf(row, setup_.robot);
  return !R_WB || (*R_WB)(2, 2) > kUpright;
}

void FieldRows::Complete(logs::Row row, const logs::Row* after) {
  const logs::RowGroups had = logs::GroupsOf(row);
  const bool placed = IsNewPlace(row);
  if (placed) {
    ++segment_;
    if (!fallen_ || IsUpright(row)) {  // else its estimate is lost while it tumbles
      fallen_ = false;
      detector_.Reset();
    }
    clues_.Reset();
    before_.reset();
  }
  const bool begins = placed || !last_.time_s;
  const double dt_s = begins ? 0.0 : row.time_s - *last_.time_s;
  const std::optional<logs::Array12> qd_radps = SpeedsAt(row, after);
  bool operating = false;
  if (!row.episode) {
    operating = FindFall(row, dt_s);
  } else {
    if (row.episode->fallen && !fallen_) Count(row, "the log's own account");
    fallen_ = row.episode->fallen;
  }
  last_ = {row.time_s, std::nullopt, std::nullopt, std::nullopt};
  if (row.estimate) {
    last_.p_WB = logs::ToVec3(row.estimate->p_WB_m);
    last_.v_WB = logs::ToVec3(row.estimate->v_WB_mps);
  }
  if (row.measured) last_.q_rad = row.measured->q_rad;
  before_.reset();
  if (last_.q_rad) before_ = {row.time_s, *last_.q_rad};
  FillContacts(row);
  FillEnergy(row, qd_radps, dt_s);
  if (!row.episode) row.episode = {rows_, operating, fallen_ || stopped_, segment_};
  ++rows_;
  Held held{std::move(row), had, qd_radps, dt_s, begins};
  if (setup_.odometry != Odometry::kLegs || setup_.robot == nullptr) {
    HandOn(std::move(held), std::nullopt);
    return;
  }
  if (placed) smoother_.Finish();
  smoother_.Add(CalcVelocityClue(*setup_.robot, held.row, qd_radps, setup_.gravity_mps2));
  held_.push_back(std::move(held));
  HandOnSmoothed();
}

void FieldRows::HandOnSmoothed() {
  for (const Vec3& v_WS : smoother_.Take()) {
    HandOn(std::move(held_.front()), v_WS);
    held_.pop_front();
  }
}

/// @param v_WS  of the IMU, where the legs tell the motion.
void FieldRows::HandOn(Held held, const std::optional<Vec3>& v_WS) {
  FillMotion(held, v_WS);
  FillTrueContacts(held.row, held.qd_radps);
  FillMass(held.row);
  on_row_(held.row, logs::GroupsOf(held.row) & ~held.had);
}

std::optional<FallVerdict> FieldRows::LabelNear(double time_s) const {
  std::optional<FallVerdict> nearest;
  double distance_s = kLabel_s;
  for (const FallLabel& label : setup_.labels) {
    const double away_s = std::abs(label.time_s - time_s);
    if (away_s > distance_s) continue;
    distance_s = away_s;
    nearest = label.verdict;
  }
  return nearest;
}

void FieldRows::Count(const logs::Row& row, std::string cause) {
  FallEvent event{row.time_s, std::move(cause), std::nullopt};
  if (row.estimate) event.p_WB = logs::ToVec3(row.estimate->p_WB_m).head<2>();
  falls_.push_back(std::move(event));
  fallen_ = true;
}

/// A fall that somebody saw and the log does not show, or that an operator prevented.
void FieldRows::ApplyLabels(const logs::Row& row) {
  while (next_label_ < setup_.labels.size() && setup_.labels[next_label_].time_s <= row.time_s) {
    const FallLabel& label = setup_.labels[next_label_++];
    const bool counted =
        !falls_.empty() && std::abs(falls_.back().time_s - label.time_s) <= kLabel_s;
    if (label.verdict == FallVerdict::kFall && !counted) Count(row, "label");
    if (label.verdict == FallVerdict::kOperatorStop) stopped_ = true;
  }
}

/// @returns whether it walks, or stands to walk.
bool FieldRows::FindFall(const logs::Row& row, double dt_s) {
  ApplyLabels(row);
  const FallSample sample = clues_.Update(row, dt_s);
  posture_.Update(sample);
  const bool operating = setup_.has_plan ? row.plan.has_value() : posture_.stands();
  const FallState before = detector_.state();
  constexpr double kNotOverdue_s = -1.0;  // a log does not say when standing up should have ended
  const FallCause cause =
      operating ? detector_.Update(sample) : detector_.UpdateStandUp(sample, kNotOverdue_s);
  if (before == FallState::kFallen && detector_.state() == FallState::kUpright) {
    ++segment_;  // set on its feet by hand
    fallen_ = stopped_ = false;
  }
  if (cause == FallCause::kNone) return operating;
  if (!setup_.has_plan && LiesDown(row, cause)) {
    posture_.Lie();
    detector_.Reset();
    return false;
  }
  CountOnce(row, cause);
  return operating;
}

/// A robot that is told to walk does not lie down.
bool FieldRows::LiesDown(const logs::Row& row, FallCause cause) const {
  constexpr double kStill_mps = 0.05;
  const bool is_still = !row.command || SpeedOf(*row.command) < kStill_mps;
  return cause != FallCause::kTilt && is_still && posture_.CameDownSlowly();
}

void FieldRows::CountOnce(const logs::Row& row, FallCause cause) {
  const double since_s = falls_.empty() ? kLabel_s + 1.0 : row.time_s - falls_.back().time_s;
  const bool counted =
      since_s <= kOneFall_s || (since_s <= kLabel_s && falls_.back().cause == "label");
  if (counted) fallen_ = true;
  const std::optional<FallVerdict> label = LabelNear(row.time_s);
  if (counted || (label && *label != FallVerdict::kFall)) return;
  Count(row, std::string(core::EnumName(cause)));
}

std::optional<logs::Array12> FieldRows::SpeedsAt(const logs::Row& row,
                                                 const logs::Row* after) const {
  if (!row.measured) return std::nullopt;
  if (setup_.joint_speed == JointSpeed::kMeasured) return row.measured->qd_radps;
  if (!row.measured->q_rad || !before_ || after == nullptr || !after->measured ||
      !after->measured->q_rad || after->time_s - row.time_s > setup_.gap_s ||
      after->time_s <= before_->first)
    return std::nullopt;
  return CalcJointDerivative(before_->second, *after->measured->q_rad,
                             after->time_s - before_->first);
}

void FieldRows::FillMotion(Held& held, const std::optional<Vec3>& v_WS) {
  logs::Row& row = held.row;
  if (row.truth) return;
  std::optional<logs::TruthRow> truth;
  if (setup_.odometry == Odometry::kEstimate && row.estimate) {
    truth.emplace().p_WB_m = row.estimate->p_WB_m;
    truth->v_WB_mps = row.estimate->v_WB_mps;
    truth->rpy_rad = row.estimate->rpy_rad;
  } else if (v_WS) {
    truth = MotionByLegs(held, *v_WS);
  }
  if (!truth) return;
  const Mat3 R_WB = core::RotationFromRpy(logs::ToVec3(truth->rpy_rad));
  if (const std::optional<Vec3> w_WB_B = RateOf(row, setup_.robot)) {
    truth->w_WB_radps = logs::ToArray(R_WB * *w_WB_B);
  } else if (last_R_WB_ && held.dt_s > 0.0) {
    truth->w_WB_radps = logs::ToArray(core::LogSo3(R_WB * last_R_WB_->transpose()) / held.dt_s);
  }
  last_R_WB_ = R_WB;
  row.truth = truth;
}

/// Where it was set down is where its own estimate begins, if it has one.
std::optional<logs::TruthRow> FieldRows::MotionByLegs(const Held& held, const Vec3& v_WS) {
  const logs::Row& row = held.row;
  const std::optional<Mat3> R_WB = AttitudeOf(row, setup_.robot);
  if (!R_WB) return std::nullopt;
  Vec3 v_WB = v_WS;
  if (const std::optional<Vec3> w_WB_B = RateOf(row, setup_.robot))
    v_WB -= *R_WB * w_WB_B->cross(setup_.robot->p_BS);
  p_legs_W_ += held.dt_s * v_WB;
  if (held.begins && row.estimate) p_legs_W_ = logs::ToVec3(row.estimate->p_WB_m);
  logs::TruthRow truth;
  truth.p_WB_m = logs::ToArray(p_legs_W_);
  truth.v_WB_mps = logs::ToArray(v_WB);
  truth.rpy_rad = logs::ToArray(core::RpyFromRotation(*R_WB));
  return truth;
}

void FieldRows::FillContacts(logs::Row& row) {
  if (setup_.has_contacts || row.contacts || !row.measured || !row.measured->tau_Nm) return;
  const LegArray<bool> loaded = stance_.Update(Unflatten(*row.measured->tau_Nm));
  logs::ContactsRow& contacts = row.contacts.emplace();
  for (const Leg leg : kLegs) contacts.contact[static_cast<std::size_t>(leg)] = loaded[leg];
}

void FieldRows::FillTrueContacts(logs::Row& row,
                                 const std::optional<logs::Array12>& qd_radps) const {
  if (row.true_contacts || !row.contacts) return;
  logs::TrueContactsRow& contacts = row.true_contacts.emplace();
  contacts.contact = row.contacts->contact;
  FeetMotion feet;
  if (setup_.robot != nullptr) feet = CalcFeetMotion(*setup_.robot, row, qd_radps);
  contacts.p_WF_m = feet.p_WF_m;
  if (!row.contacts->f_F_W_N || !setup_.mass_kg) return;
  for (const Leg leg : kLegs) {
    const auto k = static_cast<std::size_t>(leg);
    contacts.contact[k] = (*row.contacts->f_F_W_N)[3 * k + 2] > LeastForce(feet.speed_mps[leg]);
  }
}

/// Vertical force above which a foot stands, N: of one at rest, or rolling, what the simulator says
/// of true contacts; in motion a leg's own acceleration reads as force.
/// @param speed_mps  of the foot against one that rolls; none: not known.
double FieldRows::LeastForce(const std::optional<double>& speed_mps) const {
  constexpr double kRests_N = 5.0, kMoves_N = 15.0, kUnknown_N = 7.0, kOfMass_kg = 15.0;
  constexpr double kRests = 0.3;  // of √(g h): 0.5 m/s of a Go2
  const double scale = *setup_.mass_kg / kOfMass_kg;
  if (!speed_mps) return scale * kUnknown_N;
  const double rests_mps = kRests * std::sqrt(setup_.gravity_mps2 * NominalHeight(setup_.robot));
  return scale * (*speed_mps < rests_mps ? kRests_N : kMoves_N);
}

void FieldRows::FillMass(logs::Row& row) {
  if (row.true_mass || !setup_.mass_kg) return;
  row.true_mass.emplace().mass_kg = *setup_.mass_kg;
  if (!model_ || !row.truth || !row.measured || !row.measured->q_rad) return;
  RobotState state;
  state.p_WB = logs::ToVec3(row.truth->p_WB_m);
  state.R_WB = core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
  state.q = Unflatten(*row.measured->q_rad);
  model_->Calc(state, body_);
  row.true_mass->p_BC_m = logs::ToArray(state.R_WB.transpose() * (body_.p_WC - state.p_WB));
  row.true_mass->p_WC_z_m = body_.p_WC.z();
}

/// Powers of this instant over the time since the row before.
void FieldRows::FillEnergy(logs::Row& row, const std::optional<logs::Array12>& qd_radps,
                           double dt_s) {
  if (row.energy || !row.measured) return;
  const logs::MeasuredRow& measured = *row.measured;
  const bool has_joints = measured.tau_Nm && qd_radps;
  const bool has_battery = measured.battery_V && measured.battery_A;
  cover_.all_s += dt_s;
  if (has_joints) {
    AddJointEnergy(*measured.tau_Nm, *qd_radps, dt_s);
    cover_.joints_s += dt_s;
  }
  if (has_battery) {
    energy_.battery_J += dt_s * *measured.battery_V * *measured.battery_A;
    cover_.battery_s += dt_s;
  }
  row.energy = energy_;
}

void FieldRows::AddJointEnergy(const logs::Array12& tau_Nm, const logs::Array12& qd_radps,
                               double dt_s) {
  const core::MotorParams motors =
      setup_.robot != nullptr ? setup_.robot->config.motors : core::MotorParams{};
  double electrical_W = motors.idle_W;
  for (std::size_t k = 0; k < qd_radps.size(); ++k) {
    const double power_W = tau_Nm[k] * qd_radps[k];
    const double loss = motors.copper_loss_W_per_Nm2[static_cast<Eigen::Index>(k % kJointsPerLeg)];
    energy_.mech_abs_J += dt_s * std::abs(power_W);
    energy_.mech_pos_J += dt_s * std::max(power_W, 0.0);
    electrical_W += std::max(0.0, power_W + loss * tau_Nm[k] * tau_Nm[k]);
  }
  energy_.electrical_J += dt_s * electrical_W;
}

}  // namespace scoria::analysis
