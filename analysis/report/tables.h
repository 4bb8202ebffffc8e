// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/study/compare.h"

namespace scoria::analysis {

/// Writes metrics.csv (a line per episode) and metrics.json (cells and comparisons) to a folder.
/// Errors: std::runtime_error, if a file cannot be written.
void WriteTables(const CampaignResults& results, const std::vector<Cell>& cells,
                 const std::filesystem::path& folder);

}  // namespace scoria::analysis
