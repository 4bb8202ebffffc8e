// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/survey_rows.h"

#include <algorithm>
#include <cmath>

#include "logs/format/open_log.h"
#include "logs/quality/judge.h"
#include "logs/quality/message_check.h"

namespace scoria::app {
namespace {

class RowSurveyor {
 public:
  RowSurveyor(const core::RobotDescription* robot, double gravity_mps2)
      : judge_({.robot = robot, .gravity_mps2 = gravity_mps2}) {}

  void Add(const logs::Row& row) {
    judge_.AddRow(row);
    if (survey_.rows++ == 0) survey_.first_s = row.time_s;
    const double step_s = row.time_s - survey_.last_s;
    if (survey_.rows > 1) steps_.Add(std::llround(1e9 * step_s));
    survey_.last_s = row.time_s;
    survey_.groups |= logs::GroupsOf(row);
    if (row.truth) ++survey_.with_truth;
    survey_.has_foot_forces |= row.contacts && row.contacts->f_F_W_N;
    delays_.Add(row);
    if (!row.measured) return;
    if (row.measured->q_rad && row.measured->w_WS_S_radps && row.measured->a_WS_S_mps2)
      ++survey_.with_motion;
    survey_.has_torque |= row.measured->tau_Nm.has_value();
    survey_.has_speed |= row.measured->qd_radps.has_value();
  }

  [[nodiscard]] RowsSurvey Finish(logs::RowsReport report) {
    survey_.report = std::move(report);
    survey_.findings = judge_.Conclude();
    survey_.speed_lag_s = delays_.speed_s();
    survey_.torque_lag_s = delays_.torque_s();
    if (steps_.count() > 0) survey_.median_step_s = 1e-9 * steps_.Quantile_ns(0.5);
    return survey_;
  }

 private:
  logs::LogJudge judge_;
  logs::IntervalHistogram steps_;
  analysis::JointDelays delays_;
  RowsSurvey survey_;
};

}  // namespace

RowsSurvey SurveyRows(const LogRows& rows, const core::RobotDescription* robot,
                      double gravity_mps2) {
  RowSurveyor surveyor(robot, gravity_mps2);
  logs::RowsReport report = rows.ForEach([&](const logs::Row& row) { surveyor.Add(row); });
  RowsSurvey survey = surveyor.Finish(std::move(report));
  if (rows.mapping() != nullptr) {
    const std::unique_ptr<logs::LogSource> log = logs::OpenLog(rows.files());
    const auto of_messages = logs::JudgeMessages(*log, logs::TypeResolver(rows.msg_paths()));
    survey.findings.insert(survey.findings.end(), of_messages.begin(), of_messages.end());
    std::stable_sort(survey.findings.begin(), survey.findings.end(),
                     [](const auto& a, const auto& b) { return a.severity > b.severity; });
  }
  return survey;
}

}  // namespace scoria::app
