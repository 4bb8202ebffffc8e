// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "analysis/report/document.h"
#include "analysis/study/set_comparison.h"
#include "app/compare/walk_set.h"

namespace scoria::app {

/// Two sets of walks and what differs between them.
struct WalkComparison {
  WalkSet a, b;
  analysis::SetComparison found;
  double alpha = 0.05;  // of all metrics and distributions together
};

[[nodiscard]] WalkComparison CompareWalks(WalkSet a, WalkSet b, double alpha);

/// The page: a verdict first, then a table per family with a sentence for each metric, and a figure
/// and a sentence for each distribution.
[[nodiscard]] analysis::Document ComparisonDocument(const WalkComparison& comparison);

/// The same as JSON.
[[nodiscard]] nlohmann::json ComparisonJson(const WalkComparison& comparison);

}  // namespace scoria::app
