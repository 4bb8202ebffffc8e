// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "analysis/report/report_input.h"

namespace scoria::analysis {

/// Writes metrics.csv (a line per episode) and metrics.json (cells and comparisons) to a folder.
/// Errors: core::FileError.
void WriteMetricFiles(const ReportInput& input, const std::filesystem::path& folder);

}  // namespace scoria::analysis
