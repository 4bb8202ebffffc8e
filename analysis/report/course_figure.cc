// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/course_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/plots/course_plot.h"
#include "core/files.h"
#include "core/math/angles.h"
#include "core/robot/contact.h"

namespace scoria::analysis {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 4> kLegs = {"FL", "FR", "HL", "HR"};
constexpr std::array<const char*, 6> kStages = {"mpc",     "body",    "estimator",
                                                "contact", "footing", "load"};

/// A foot's own sensor is at work but not trusted, and the momentum observer is used for it.
bool HasDistrustedSensor(const logs::Row& r) {
  if (!r.contacts || !r.contacts->source || !r.contacts->sensor) return false;
  for (std::size_t leg = 0; leg < kLegs.size(); ++leg) {
    const auto source = static_cast<ContactSource>((*r.contacts->source)[leg]);
    if (source == ContactSource::kObserver && !r.contacts->sensor->healthy[leg]) return true;
  }
  return false;
}

/// Height of the centre of mass and of its reference over the ground, m; NaN where one is unknown.
std::array<double, 2> HeightsOf(const logs::Row& r) {
  if (!r.truth || !r.truth->ground_z_m) return {kNan, kNan};
  const double ground_z_m = *r.truth->ground_z_m;
  return {r.true_mass ? r.true_mass->p_WC_z_m - ground_z_m : kNan,
          r.reference ? r.reference->p_WC_m[2] - HeightDrift(r).value_or(0.0) - ground_z_m : kNan};
}

bool BearsWeight(const logs::Row& r, std::size_t leg) {
  if (r.true_contacts) return r.true_contacts->contact[leg];
  return r.contacts && r.contacts->contact[leg];
}

struct CourseColumns {
  std::vector<double> time_s, height_m, reference_m, speed_mps, command_mps, roll_deg, pitch_deg;
  std::array<std::vector<bool>, kLegs.size()> stance;
  std::vector<bool> sensor;
  std::array<std::vector<bool>, kStages.size()> stage;

  void Add(const logs::Row& r) {
    time_s.push_back(r.time_s);
    const auto [height, reference] = HeightsOf(r);
    height_m.push_back(height);
    reference_m.push_back(reference);
    AddMotion(FindMotion(r));
    command_mps.push_back(r.command ? r.command->v_x_mps : kNan);
    for (std::size_t leg = 0; leg < stance.size(); ++leg)
      stance[leg].push_back(BearsWeight(r, leg));
    sensor.push_back(HasDistrustedSensor(r));
    for (std::size_t i = 0; i < stage.size(); ++i)
      stage[i].push_back(r.supervision && r.supervision->fallen_back[i]);
  }

  /// By the truth, or for want of it by the estimate.
  void AddMotion(const std::optional<TrunkMotion>& motion) {
    const Vec3 rpy_rad = motion ? motion->rpy_rad : Vec3(kNan, kNan, kNan);
    const double c = std::cos(rpy_rad.z()), s = std::sin(rpy_rad.z());
    speed_mps.push_back(motion ? c * motion->v_WB.x() + s * motion->v_WB.y() : kNan);
    roll_deg.push_back(rpy_rad.x() * core::kDegreesPerRad);
    pitch_deg.push_back(rpy_rad.y() * core::kDegreesPerRad);
  }
};

std::vector<CourseState> LegStates(const CourseColumns& c) {
  std::vector<CourseState> states;
  for (std::size_t leg = 0; leg < kLegs.size(); ++leg)
    states.push_back({kLegs[leg], c.stance[leg]});
  return states;
}

std::vector<CourseState> FallbackStates(const CourseColumns& c) {
  std::vector<CourseState> states = {{"sensor", c.sensor}};
  for (std::size_t i = 0; i < kStages.size(); ++i) states.push_back({kStages[i], c.stage[i]});
  return states;
}

}  // namespace

void CourseFigure::Add(const logs::Row& row) {
  if (seen_++ % every_ != 0) return;
  rows_.push_back(row);
  if (rows_.size() <= most_rows_) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows_.size(); i += 2) rows_[kept++] = rows_[i];
  rows_.resize(kept);
  every_ *= 2;
}

CaptionedFigure CourseFigure::Draw(const std::string& name, const std::vector<double>& marks_s,
                                   const std::vector<std::pair<double, double>>& gaps_s,
                                   const std::string& caption) const {
  CourseColumns c;
  for (const logs::Row& row : rows_) c.Add(row);
  CoursePlot plot;
  plot.name = "time_" + core::FileNameOf(name);
  plot.title = "Course of " + name;
  plot.marks_s = marks_s;
  plot.gaps_s = gaps_s;
  plot.panels = {
      {.y_label = "height [m]",
       .lines = {{"COM over ground", c.height_m},
                 {"reference", c.reference_m, Palette::kVermilion, true}}},
      {.y_label = "speed [m/s]",
       .lines = {{"forward", c.speed_mps},
                 {"commanded", c.command_mps, Palette::kVermilion, true}}},
      {.y_label = "angle [deg]",
       .lines = {{"roll", c.roll_deg, Palette::kGreen}, {"pitch", c.pitch_deg, Palette::kPurple}}},
      {.y_label = "stance", .states = LegStates(c)},
      {.y_label = "fallback", .states = FallbackStates(c), .state_colour = Palette::kVermilion}};
  plot.time_s = std::move(c.time_s);
  return {DrawCourse(plot), caption};
}

}  // namespace scoria::analysis
