// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/analyze/analyze_log.h"

namespace scoria::app {

/// Writes analysis.json (logs with findings, numbers and parts; and pooled by gait sequencer and
/// commanded speed) and the report that simulated runs have, into a folder.
/// @returns the page. Errors: core::FolderInUse, core::FileError.
std::filesystem::path WriteAnalysis(const std::vector<LogAnalysis>& logs, const std::string& name,
                                    const std::filesystem::path& folder);

}  // namespace scoria::app
