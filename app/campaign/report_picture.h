// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "analysis/report/report.h"

namespace scoria::app {

/// A picture for the head of the report on a run's or campaign's folder: the first fall that one of
/// its logs shows, else the middle of a walk. Nothing where there is no log that can be drawn.
[[nodiscard]] std::optional<analysis::ReportPicture> MakeReportPicture(
    const std::filesystem::path& folder);

}  // namespace scoria::app
