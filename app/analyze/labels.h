// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/field/field_rows.h"

namespace scoria::app {

/// A line of a labels file.
struct LabelEntry {
  analysis::FallLabel label;  // its time since 1970, or as that of the rows
  std::string log;            // id of a log; empty: any
};

/// Reads a CSV of lines "time,verdict" or "time,verdict,log": seconds, and fall, not a fall or
/// operator stop. A first line that begins with "time" names the columns.
/// Errors: std::runtime_error by file and line.
[[nodiscard]] std::vector<LabelEntry> ReadLabels(const std::filesystem::path& file);

/// Those of a log, in row times, by time.
/// @param start_s  row time 0 since 1970; 0: row times are as the log's clock.
[[nodiscard]] std::vector<analysis::FallLabel> LabelsOf(const std::vector<LabelEntry>& entries,
                                                        const std::string& log, double start_s);

}  // namespace scoria::app
