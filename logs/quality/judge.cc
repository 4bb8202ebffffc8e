// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/judge.h"

#include <algorithm>

#include "logs/quality/attitude_check.h"
#include "logs/quality/clock_check.h"
#include "logs/quality/delay_check.h"
#include "logs/quality/foot_order_check.h"
#include "logs/quality/gravity_check.h"
#include "logs/quality/legs_check.h"
#include "logs/quality/load_check.h"
#include "logs/quality/rate_check.h"
#include "logs/quality/sensor_check.h"
#include "logs/quality/torque_scale_check.h"
#include "logs/quality/velocity_check.h"

namespace scoria::logs {
namespace {

QualityChecks MakeChecks(const LogSubject& subject) {
  QualityChecks checks;
  checks.push_back(std::make_unique<ClockCheck>(subject));
  checks.push_back(std::make_unique<SensorCheck>(subject));
  checks.push_back(std::make_unique<RateCheck>(subject));
  checks.push_back(std::make_unique<AttitudeCheck>(subject));
  checks.push_back(std::make_unique<DelayCheck>());
  checks.push_back(std::make_unique<GravityCheck>(subject));
  checks.push_back(std::make_unique<VelocityCheck>());
  checks.push_back(std::make_unique<LegsCheck>(subject));
  checks.push_back(std::make_unique<FootOrderCheck>(subject));
  checks.push_back(std::make_unique<LoadCheck>(subject));
  checks.push_back(std::make_unique<TorqueScaleCheck>(subject));
  return checks;
}

}  // namespace

LogJudge::LogJudge(const LogSubject& subject)
    : subject_(subject), checks_(MakeChecks(subject)), resampler_([this](const Tick& tick) {
        for (const auto& check : checks_) check->AddTick(tick);
      }) {}

void LogJudge::AddRow(const Row& row) {
  for (const auto& check : checks_) check->AddRow(row);
  std::optional<std::uint32_t> segment;
  if (row.episode) segment = row.episode->segment;
  resampler_.Add(MakeTick(row, subject_.robot), segment != segment_);
  segment_ = segment;
}

std::vector<Finding> LogJudge::Conclude() const {
  std::vector<Finding> findings;
  for (const auto& check : checks_) {
    const std::vector<Finding> more = check->Conclude(findings);
    findings.insert(findings.end(), more.begin(), more.end());
  }
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

std::vector<Finding> JudgeLog(
    const std::function<void(const std::function<void(const Row&)>&)>& for_each_row,
    const LogSubject& subject) {
  LogJudge judge(subject);
  for_each_row([&](const Row& row) { judge.AddRow(row); });
  return judge.Conclude();
}

}  // namespace scoria::logs
