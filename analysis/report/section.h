// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "analysis/report/report_input.h"

namespace scoria::analysis {

/// One section of the report. A new one is a file in report/sections and a line of AllSections.
struct Section {
  const char* key = "";  // its anchor
  const char* title = "";
  /// Why there is nothing to show, in words that follow "because"; nothing where there is.
  std::optional<std::string> (*why_not)(const ReportInput& input) = nullptr;
  /// @pre why_not() says nothing.
  Blocks (*build)(const ReportInput& input) = nullptr;
};

}  // namespace scoria::analysis
