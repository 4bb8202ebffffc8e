// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "logs/quality/finding.h"
#include "logs/row.h"

namespace scoria::test {

/// What a finding has to say to name a defect.
struct Expected {
  logs::FindingKind kind = logs::FindingKind::kNotJudged;
  std::string signal = {};  // empty: any
  std::optional<Leg> leg = std::nullopt;
  std::optional<Joint> joint = std::nullopt;
  std::optional<logs::TimeSpan> span = std::nullopt;  // ends within 0.1 s
  std::optional<double> size = std::nullopt, size_within = std::nullopt;
  std::string words = {};  // in the evidence or the repair
};

[[nodiscard]] bool Names(const logs::Finding& finding, const Expected& expected);

/// What a log has to have for a defect.
enum class Needed { kNothing, kImu, kFootForce };

/// A fault that a log or a mapping may have, of one size, in one of ten places.
struct Defect {
  std::string name;
  Needed needs = Needed::kNothing;
  /// Puts it into rows. @returns what has to be found; nothing where the log lacks the signal.
  std::function<std::optional<Expected>(std::vector<logs::Row>& rows, int place)> inject;
  int least_named = 9;  // of ten places in recordings of other simulators; of ours always nine
};

/// Those of docs/log_quality.md.
[[nodiscard]] std::vector<Defect> Defects();

}  // namespace scoria::test
