// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/signal_distributions.h"

#include <cmath>

#include "analysis/metrics/estimation_metrics.h"
#include "core/config/field.h"
#include "core/math/angles.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

/// A chord that is shorter has no cost: the robot stands or turns in place.
constexpr double kLeastChord_m = 0.02;

/// What a share of a joint's limit needs and how it is shown.
MetricInfo UseInfo(std::string_view title, std::string_view definition) {
  return {.family = MetricFamily::kEnergy,
          .title = title,
          .shown_unit = "%",
          .scale = 100.0,
          .digits = 1,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kMeasured}),
          .definition = definition};
}

/// What a number of the feet's strides and stances needs.
MetricInfo StepInfo(MetricFamily family, std::string_view title, std::string_view definition) {
  return {.family = family,
          .title = title,
          .digits = 3,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueContacts}),
          .definition = definition};
}

MetricInfo ErrorInfo(std::string_view title, std::string_view definition) {
  return {.family = MetricFamily::kTracking,
          .title = title,
          .needs = Groups(
              {RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kCommand, RowGroup::kReference}),
          .definition = definition};
}

MetricInfo ShownAs(MetricInfo info, std::string_view unit, std::string_view shown_unit,
                   double scale, int digits) {
  info.unit = unit;
  info.shown_unit = shown_unit;
  info.scale = scale;
  info.digits = digits;
  return info;
}

MetricInfo Describe(Signal signal) {
  switch (signal) {
    case Signal::kStride:
      return ShownAs(StepInfo(MetricFamily::kGait, "stride time",
                              "A stride of any leg, from touchdown to touchdown."),
                     "s", "", 1.0, 3);
    case Signal::kDuty:
      return StepInfo(MetricFamily::kGait, "duty", "Share of a stride on the ground.");
    case Signal::kSlip:
      return ShownAs(StepInfo(MetricFamily::kContact, "slip",
                              "Way of a foot on the map from touchdown to lift-off."),
                     "m", "mm", 1e3, 1);
    case Signal::kFootForce:
      return {.family = MetricFamily::kContact,
              .unit = "N",
              .title = "foot force",
              .digits = 1,
              .needs = Groups({RowGroup::kEpisode, RowGroup::kContacts}),
              .definition = "Estimated force of the ground on a foot in contact, every row."};
    case Signal::kTorqueUse:
      return UseInfo("torque use",
                     "Measured torque of a joint over its limit, every joint and row.");
    case Signal::kSpeedUse:
      return UseInfo("joint speed use",
                     "Measured speed of a joint over its limit, every joint and row.");
    case Signal::kCost:
      return {.family = MetricFamily::kTransport,
              .title = "CoT",
              .needs = Groups(
                  {RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kTrueMass, RowGroup::kEnergy}),
              .definition = "Σ|τω| of a half-second chord over m g ds."};
    case Signal::kNis:
      return {.family = MetricFamily::kEstimation,
              .title = "NIS / dof",
              .needs = Groups({RowGroup::kEpisode, RowGroup::kEstimate}),
              .definition =
                  "Normalised innovation squared of a correction by the feet, over its "
                  "degrees of freedom."};
    case Signal::kHeightError: {
      MetricInfo info = ShownAs(
          ErrorInfo("height error", "Magnitude of what the height RMSE is of."), "m", "mm", 1e3, 1);
      info.needs |= Groups({RowGroup::kTrueMass});
      return info;
    }
    case Signal::kTiltError:
      return ShownAs(ErrorInfo("tilt error", "Errors of roll and pitch, root of their squares."),
                     "rad", "deg", core::kDegreesPerRad, 2);
  }
  return {};
}

template <class Limit>
logs::Array12 LimitsOf(const core::RobotDescription& robot, Limit limit) {
  logs::Array12 all{};
  auto next = all.begin();
  for (const core::LegDescription& leg : robot.legs) {
    for (const core::JointDescription& joint : leg.joints) *next++ = limit(joint);
  }
  return all;
}

double NormOfLeg(const logs::Array12& f, std::size_t leg) {
  return std::hypot(f[3 * leg], f[3 * leg + 1], f[3 * leg + 2]);
}

}  // namespace

MetricInfo InfoOf(Signal signal) {
  MetricInfo info = Describe(signal);
  info.key = core::EnumName(signal);
  return info;
}

SignalAccumulator::SignalAccumulator(double gravity_mps2, const core::RobotDescription* robot)
    : gravity_mps2_(gravity_mps2) {
  if (robot == nullptr) return;
  most_Nm_ = LimitsOf(*robot, [](const core::JointDescription& j) { return j.effort_Nm; });
  most_radps_ = LimitsOf(*robot, [](const core::JointDescription& j) { return j.velocity_radps; });
}

void SignalAccumulator::AddRow(const logs::Row& row) {
  if (!row.episode) return;
  const bool walks = row.episode->operating && !row.episode->fallen;
  if (!walks || !walks_ || row.episode->segment != segment_) Break();
  walks_ = walks;
  segment_ = row.episode->segment;
  if (row.true_contacts) slips_.AddRow(row, [this](double slip_m) { Add(Signal::kSlip, slip_m); });
  if (walks) {
    AddGait(row);
    AddEffort(row);
    AddCost(row);
    AddErrors(row);
  }
  last_s_ = row.time_s;
}

/// What comes next does not go on with what was before.
void SignalAccumulator::Break() noexcept {
  gait_.Break();
  path_.Lift();
  chord_energy_J_.reset();
  command_.Restart();
}

void SignalAccumulator::AddGait(const logs::Row& row) {
  if (!row.true_contacts) return;
  gait_.Add(row.time_s, row.true_contacts->contact, [this](const Stride& stride) {
    Add(Signal::kStride, stride.stride_s);
    Add(Signal::kDuty, stride.stance_s / stride.stride_s);
  });
}

void SignalAccumulator::AddEffort(const logs::Row& row) {
  const auto add_use = [this](Signal signal, const std::optional<logs::Array12>& values,
                              const std::optional<logs::Array12>& limits) {
    if (!values || !limits) return;
    for (std::size_t k = 0; k < values->size(); ++k) {
      if ((*limits)[k] > 0.0) Add(signal, std::abs((*values)[k]) / (*limits)[k]);
    }
  };
  if (row.measured) {
    add_use(Signal::kTorqueUse, row.measured->tau_Nm, most_Nm_);
    add_use(Signal::kSpeedUse, row.measured->qd_radps, most_radps_);
  }
  if (row.contacts && row.contacts->f_F_W_N) {
    for (std::size_t leg = 0; leg < row.contacts->contact.size(); ++leg) {
      if (row.contacts->contact[leg])
        Add(Signal::kFootForce, NormOfLeg(*row.contacts->f_F_W_N, leg));
    }
  }
  if (row.estimate && row.estimate->innovation && row.estimate->innovation->dof > 0)
    Add(Signal::kNis, row.estimate->innovation->nis / row.estimate->innovation->dof);
}

void SignalAccumulator::AddCost(const logs::Row& row) {
  if (!row.truth || !row.true_mass || !row.energy) return;
  const double energy_J = row.energy->mech_abs_J;
  const double dt_s = chord_energy_J_ ? row.time_s - last_s_ : 0.0;
  const std::optional<double> chord_m =
      path_.Add({dt_s, {row.truth->p_WB_m[0], row.truth->p_WB_m[1]}});
  if (chord_m && *chord_m >= kLeastChord_m)
    Add(Signal::kCost,
        (energy_J - *chord_energy_J_) / (row.true_mass->mass_kg * gravity_mps2_ * *chord_m));
  if (chord_m || !chord_energy_J_) chord_energy_J_ = energy_J;
}

/// Of steady walking, as the root mean squares are.
void SignalAccumulator::AddErrors(const logs::Row& row) {
  if (!row.truth || !row.command || !row.reference) return;
  command_.Update(row.time_s, *row.command);
  if (!command_.IsSettled(row.time_s)) return;
  Add(Signal::kTiltError, std::hypot(row.truth->rpy_rad[0] - row.reference->rpy_rad[0],
                                     row.truth->rpy_rad[1] - row.reference->rpy_rad[1]));
  if (row.true_mass)
    Add(Signal::kHeightError, std::abs(row.true_mass->p_WC_z_m + HeightDrift(row).value_or(0.0) -
                                       row.reference->p_WC_m[2]));
}

}  // namespace scoria::analysis
