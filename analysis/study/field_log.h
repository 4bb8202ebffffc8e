// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/report/document.h"
#include "logs/quality/finding.h"

namespace scoria::analysis {

/// The log of a robot, as it was analysed.
struct FieldLog {
  std::string id;
  std::vector<std::filesystem::path> files;
  std::string robot, mass;              // which, and how it is known, in words
  std::vector<std::string> remarks;     // how it was read, and what is wrong with its files
  std::vector<std::string> accepted;    // findings that were repaired or left out
  std::vector<logs::Finding> findings;  // after that
  EpisodeMetrics metrics;               // of the whole log
  std::vector<CaptionedFigure> figures;
};

}  // namespace scoria::analysis
