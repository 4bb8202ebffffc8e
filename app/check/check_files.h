// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "app/check/run_checks.h"

namespace scoria::app {

/// The outcomes as JUnit XML: a test case for each scenario and campaign, its broken bounds as one
/// failure, and files to look at in its output.
/// Source: the schema of Jenkins' xUnit plugin, junit-10.xsd.
[[nodiscard]] std::string ToJunit(std::span<const CheckOutcome> outcomes);

/// The outcomes with every bound and what was found, as JSON.
[[nodiscard]] std::string ToJsonText(std::span<const CheckOutcome> outcomes);

/// A test's errors and broken bounds, a line each: "falls is 2, must be 0".
[[nodiscard]] std::vector<std::string> ProblemsOf(const CheckOutcome& outcome);

}  // namespace scoria::app
