// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/analyze_log.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "analysis/field/aligned_rows.h"
#include "analysis/metrics/metrics.h"
#include "analysis/report/course_figure.h"
#include "app/analyze/accept.h"
#include "app/analyze/find_robot.h"
#include "app/analyze/survey_rows.h"

namespace scoria::app {
namespace {

using analysis::JointSpeed;
using analysis::Odometry;
using logs::RowGroup;

bool Has(const logs::RowGroups& groups, RowGroup group) {
  return groups[static_cast<std::size_t>(group)];
}

bool IsMost(std::uint64_t rows, const RowsSurvey& survey) {
  constexpr double kMostRows = 0.9;
  return static_cast<double>(rows) > kMostRows * static_cast<double>(survey.rows);
}

/// Legs and accelerometer come before the robot's own estimate where the log has contacts, unless
/// what is measured is wrong all through.
Odometry ChooseOdometry(const RowsSurvey& survey, bool has_robot) {
  if (IsMost(survey.with_truth, survey)) return Odometry::kTruth;
  const bool is_wrong =
      std::any_of(survey.findings.begin(), survey.findings.end(), [](const logs::Finding& finding) {
        return finding.severity == logs::Severity::kError && finding.spans.empty() &&
               Has(finding.spoils, RowGroup::kMeasured);
      });
  const bool has_contacts = Has(survey.groups, RowGroup::kContacts);
  if (has_robot && has_contacts && IsMost(survey.with_motion, survey) && !is_wrong)
    return Odometry::kLegs;
  if (Has(survey.groups, RowGroup::kEstimate)) return Odometry::kEstimate;
  return has_robot && (has_contacts || survey.has_torque) ? Odometry::kLegs : Odometry::kNone;
}

JointSpeed SpeedOf(const RowsSurvey& survey) {
  if (!survey.has_speed) return JointSpeed::kDerivative;
  return analysis::ChooseJointSpeed(survey.speed_lag_s, survey.torque_lag_s);
}

std::string SpeedText(const RowsSurvey& survey, JointSpeed speed) {
  if (!survey.has_speed)
    return "the centred derivative of the joint angles, because no speeds were measured";
  const std::string speeds =
      survey.speed_lag_s ? fmt::format("{:.1f} ms after the angles", 1e3 * *survey.speed_lag_s)
                         : std::string("by how much after the angles is not known");
  const std::string torques =
      survey.torque_lag_s
          ? fmt::format("{:.1f} ms after their commands", 1e3 * *survey.torque_lag_s)
          : std::string("by how much after their commands is not known");
  return fmt::format("{} (speeds come {}, torques {})",
                     speed == JointSpeed::kMeasured ? "the measured joint speeds"
                                                    : "the centred derivative of the joint angles",
                     speeds, torques);
}

/// In words, what stood in for the groups that the log lacks.
analysis::Substitutes Describe(const analysis::FieldSetup& setup, const RowsSurvey& survey,
                               const logs::RowGroups& stand_ins, const std::string& mass) {
  const bool by_torque = Has(stand_ins, RowGroup::kContacts);
  const bool by_force = survey.has_foot_forces && setup.mass_kg;
  const std::string fused =
      by_torque ? "contacts by the torques of the legs" : "contacts as the log has them";
  const std::string contacts =
      by_force && !by_torque ? "contacts by the forces of the feet as the log has them" : fused;
  analysis::Substitutes all;
  const char* walking = setup.has_plan
                            ? "the log has the controller's plan and the robot has not fallen"
                        : setup.robot != nullptr ? "the robot stands and has not fallen"
                                                 : "the robot has not fallen";
  all[RowGroup::kEpisode] = fmt::format(
      "walking is when {}; falls by tilt, height over the feet, and load that the feet do not "
      "carry",
      walking);
  all[RowGroup::kTruth] =
      setup.odometry == Odometry::kEstimate
          ? "motion of the trunk by the robot's own estimate"
          : fmt::format(
                "motion of the trunk by its legs (feet in contact roll; those that slip "
                "lose their weight){}, {}",
                survey.with_motion > 0 ? " and the accelerometer" : "", fused);
  all[RowGroup::kTrueContacts] = contacts;
  all[RowGroup::kTrueMass] = mass;
  all[RowGroup::kEnergy] = fmt::format("measured torques with {}; battery: voltage times current",
                                       SpeedText(survey, setup.joint_speed));
  for (const auto& [group, name] : EnumNames(RowGroup{})) {
    if (!Has(stand_ins, group)) all.erase(group);
  }
  return all;
}

/// Why energies are not given that the rows seem to have.
void Withhold(const analysis::EnergyCover& cover, bool has_robot,
              analysis::EpisodeMetrics& metrics) {
  constexpr double kEnough = 0.98;
  const auto share = [&](double covered_s) {
    return cover.all_s > 0.0 ? covered_s / cover.all_s : 0.0;
  };
  if (!metrics.substitutes.contains(RowGroup::kEnergy)) return;
  if (share(cover.joints_s) < kEnough) {
    for (const char* key : {"cot_mech_abs", "cot_mech_pos", "cot_electrical"})
      metrics.withheld[key] =
          fmt::format("torques and joint speeds are known for {:.0f} % of the time",
                      100.0 * share(cover.joints_s));
  } else if (!has_robot) {
    metrics.withheld["cot_electrical"] = "the robot's motors are not known";
  }
  if (share(cover.battery_s) < kEnough)
    metrics.withheld["cot_battery"] = fmt::format(
        "voltage and current are known for {:.0f} % of the time", 100.0 * share(cover.battery_s));
}

bool IsWithin(double time_s, const std::vector<logs::TimeSpan>& spans) {
  return std::any_of(spans.begin(), spans.end(), [&](const logs::TimeSpan& span) {
    return time_s >= span.begin_s && time_s <= span.end_s;
  });
}

std::vector<std::pair<double, double>> GapsOf(const std::vector<logs::Finding>& findings) {
  std::vector<std::pair<double, double>> gaps;
  for (const logs::Finding& finding : findings) {
    if (finding.kind != logs::FindingKind::kGap) continue;
    for (const logs::TimeSpan& span : finding.spans) gaps.emplace_back(span.begin_s, span.end_s);
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

/// One log, pass by pass.
class Analysis {
 public:
  Analysis(const std::vector<std::filesystem::path>& files, const AnalyzeOptions& options)
      : options_(options), rows_(files, options.rows) {
    result_.log.files = files;
  }

  LogAnalysis Run(const std::string& id, const std::string& hint) {
    result_.log.id = id;
    const std::filesystem::path mapped =
        rows_.mapping() != nullptr ? rows_.mapping()->file().robot : std::filesystem::path();
    robot_ = FindRobot(options_.robot, rows_.files().front(), mapped, hint);
    result_.log.robot = robot_.robot
                            ? fmt::format("{} ({})", robot_.robot->config.name, robot_.source)
                            : robot_.source;
    Survey();
    AlignTruth();
    SetUp();
    Measure();
    return std::move(result_);
  }

 private:
  void Survey() {
    survey_ = SurveyRows(rows_, robot_.robot.get(), options_.gravity_mps2);
    if (!options_.accept.empty()) {
      Accepted accepted = Accept(options_.accept, survey_.findings, rows_.mapping());
      left_out_ = accepted.left_out;
      result_.log.accepted = accepted.remarks;
      if (accepted.mapping) {
        rows_.SetMapping(std::move(*accepted.mapping));
        survey_ = SurveyRows(rows_, robot_.robot.get(), options_.gravity_mps2);
      }
    }
    result_.log.findings = survey_.findings;
    if (survey_.rows == 0)
      throw std::runtime_error(fmt::format("{}: gives no rows{}{}", rows_.files().front().string(),
                                           survey_.report.problem.empty() ? "" : ": ",
                                           survey_.report.problem));
    const auto& mapping = survey_.report.mapping;
    result_.log.remarks.push_back(mapping ? fmt::format("rows by the mapping {}", mapping->mapping)
                                          : std::string("rows of its own"));
    if (!survey_.report.problem.empty()) result_.log.remarks.push_back(survey_.report.problem);
  }

  void AlignTruth() {
    const auto& mapping = survey_.report.mapping;
    if (!mapping || !mapping->truth_is_of_markers) return;
    analysis::TruthAlignmentEstimator estimator(robot_.robot.get(), options_.gravity_mps2);
    rows_.ForEach([&](const logs::Row& row) { estimator.AddRow(row); });
    result_.truth_alignment = estimator.Estimate();
    result_.log.remarks.push_back("a body of markers shows the truth: " +
                                  analysis::DescribeAlignment(*result_.truth_alignment));
  }

  /// Rows whose truth is the trunk's, where that is known.
  void ForEachAlignedRow(const std::function<void(const logs::Row&)>& on_row) const {
    const auto& found = result_.truth_alignment;
    if (!found || !found->alignment) {
      rows_.ForEach(on_row);
      return;
    }
    analysis::AlignedRows aligned(*found->alignment, on_row);
    rows_.ForEach([&](const logs::Row& row) { aligned.Add(row); });
    aligned.Finish();
  }

  void SetUp() {
    setup_.robot = robot_.robot.get();
    setup_.gravity_mps2 = options_.gravity_mps2;
    setup_.odometry = ChooseOdometry(survey_, robot_.robot != nullptr);
    setup_.joint_speed = SpeedOf(survey_);
    setup_.has_plan = Has(survey_.groups, RowGroup::kPlan);
    setup_.has_contacts = Has(survey_.groups, RowGroup::kContacts);
    const auto& mapping = survey_.report.mapping;
    const std::int64_t start_ns = mapping ? mapping->start_ns.value_or(0) : 0;
    setup_.labels = LabelsOf(options_.labels, result_.log.id, 1e-9 * static_cast<double>(start_ns));
    constexpr double kGap_s = 0.1, kGapSteps = 10.0;
    setup_.gap_s = std::max(kGap_s, kGapSteps * survey_.median_step_s);
    setup_.mass_kg = options_.mass_kg;
    result_.log.mass = "not known; name the robot by --robot, or the mass by --mass";
    if (options_.mass_kg) {
      result_.log.mass = fmt::format("{:.3f} kg, as asked for", *options_.mass_kg);
    } else if (robot_.robot != nullptr) {
      setup_.mass_kg = robot_.robot->total_mass_kg();
      result_.log.mass =
          fmt::format("{:.3f} kg, the robot's own, without payload", *setup_.mass_kg);
    }
  }

  void Measure() {
    const auto& mapping = survey_.report.mapping;
    const ReferenceSeries series =
        ReadReferenceSeries(rows_, survey_.first_s, mapping ? mapping->base_topic : "");
    analysis::MetricsAccumulator whole(options_.gravity_mps2);
    analysis::SignalAccumulator signals(options_.gravity_mps2, robot_.robot.get());
    WalkParts parts(series.sequencer, options_.gravity_mps2);
    constexpr std::size_t kMostRows = 20'000;
    analysis::CourseFigure course(kMostRows);
    logs::RowGroups stand_ins;
    analysis::TrajectoryErrorAccumulator trajectory;
    const analysis::FieldRows* completed = nullptr;
    analysis::FieldRows rows(setup_, [&](const logs::Row& row, const logs::RowGroups& filled) {
      stand_ins |= filled;
      whole.AddRow(row, filled);
      signals.AddRow(row);
      if (!Has(filled, RowGroup::kTruth)) trajectory.AddRow(row);
      parts.AddRow(row, filled, completed->falls());
      course.Add(row);
    });
    completed = &rows;
    ForEachAlignedRow([&](const logs::Row& row) {
      if (!IsWithin(row.time_s, left_out_)) rows.Add(row);
    });
    rows.Finish();
    if (survey_.with_truth > 0) result_.trajectory_error = trajectory.Finish();
    for (const analysis::FallEvent& fall : rows.falls()) whole.AddFall(fall);
    const auto finish = [&](analysis::EpisodeMetrics& metrics) {
      metrics.substitutes = Describe(setup_, survey_, stand_ins, result_.log.mass);
      Withhold(rows.cover(), robot_.robot != nullptr, metrics);
    };
    analysis::EpisodeMetrics& metrics = result_.log.metrics;
    metrics = whole.Finish();
    metrics.duration_s = survey_.last_s - survey_.first_s;
    metrics.outcome = {static_cast<int>(rows.falls().size()), std::nullopt, std::nullopt};
    finish(metrics);
    result_.signals = signals.Finish();
    result_.parts = parts.Finish();
    for (WalkParts::Part& part : result_.parts) finish(part.metrics);
    if (!series.cpu_power_W.empty()) {
      double sum_W = 0.0;
      for (const SeriesSample& sample : series.cpu_power_W) sum_W += sample.value;
      result_.cpu_power_W = sum_W / static_cast<double>(series.cpu_power_W.size());
    }
    Draw(course);
  }

  void Draw(const analysis::CourseFigure& course) {
    if (course.IsEmpty()) return;
    std::vector<double> falls_s;
    for (const analysis::FallEvent& fall : result_.log.metrics.falls)
      falls_s.push_back(fall.time_s);
    result_.log.figures.push_back(
        course.Draw(result_.log.id, falls_s, GapsOf(survey_.findings),
                    "Vertical dashes mark falls. No line is drawn across a gap of the log."));
  }

  const AnalyzeOptions& options_;
  LogRows rows_;
  FoundRobot robot_;
  RowsSurvey survey_;
  std::vector<logs::TimeSpan> left_out_;
  analysis::FieldSetup setup_;
  LogAnalysis result_;
};

}  // namespace

LogAnalysis AnalyzeLog(const std::vector<std::filesystem::path>& files, const std::string& id,
                       const std::string& hint, const AnalyzeOptions& options) {
  return Analysis(files, options).Run(id, hint);
}

}  // namespace scoria::app
