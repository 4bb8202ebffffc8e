// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace scoria::analysis {

/// What the head of a report shows beside the verdicts.
struct ReportPicture {
  std::string jpeg, caption;
};

/// Writes the report of a campaign's or a run's folder into FOLDER/report: report.html
/// (self-contained, videos linked), metrics.csv, metrics.json, figures as SVG, PNG, PDF and gnuplot
/// script.
/// A result or log that cannot be read, or a figure that gnuplot refuses, is a sentence in it.
/// @returns the page. Errors: std::runtime_error, core::FolderInUse, core::FileError.
std::filesystem::path WriteReport(const std::filesystem::path& folder,
                                  const std::optional<ReportPicture>& picture = std::nullopt);

}  // namespace scoria::analysis
