// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "analysis/report/document.h"
#include "analysis/report/report_input.h"

namespace scoria::analysis {

/// Verdicts and picture first, then every section that has something to show, and last the others
/// with their reasons.
[[nodiscard]] Document ComposeReport(const ReportInput& input);

/// Writes the report of a campaign's or a run's folder into FOLDER/report: report.html
/// (self-contained, videos linked), report.txt, metrics.csv, metrics.json, figures as SVG, PNG, PDF
/// and gnuplot script.
/// A result or log that cannot be read, or a figure that gnuplot refuses, is a sentence in it.
/// @returns the page. Errors: std::runtime_error, core::FolderInUse, core::FileError.
std::filesystem::path WriteReport(const std::filesystem::path& folder,
                                  const std::optional<ReportPicture>& picture = std::nullopt,
                                  const Metrics& metrics = AllMetrics(), const TestGoal& goal = {});

/// Likewise of what is at hand, into `out`.
std::filesystem::path WriteReport(const ReportInput& input, const std::filesystem::path& out);

}  // namespace scoria::analysis
