// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "logs/quality/finding.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/resampler.h"

namespace scoria::logs {

/// Judges the rows of a log as they come; memory does not grow with their number.
///
///     LogJudge judge({.robot = &robot});
///     ForEachRow(log, [&](const Row& row) { judge.AddRow(row); });
///     const std::vector<Finding> findings = judge.Conclude();
class LogJudge {
 public:
  explicit LogJudge(const LogSubject& subject);
  LogJudge(const LogJudge&) = delete;
  LogJudge& operator=(const LogJudge&) = delete;

  void AddRow(const Row& row);

  /// What is the matter with the rows so far, worst first. Nothing is repaired or left out of them.
  [[nodiscard]] std::vector<Finding> Conclude() const;

 private:
  LogSubject subject_;
  QualityChecks checks_;  // what later ones conclude depends on what earlier ones found
  Resampler resampler_;
  std::optional<std::uint32_t> segment_;
};

/// As LogJudge, of all the rows that `for_each_row` calls its argument with.
[[nodiscard]] std::vector<Finding> JudgeLog(
    const std::function<void(const std::function<void(const Row&)>&)>& for_each_row,
    const LogSubject& subject);

}  // namespace scoria::logs
