// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/report/document.h"
#include "logs/read_rows.h"

namespace scoria::analysis {

/// Course of learned, used and true mass and centre of mass over a log.
/// @param name of the episode.
[[nodiscard]] CaptionedFigure ModelCourse(const logs::LogContent& log, const std::string& name);

}  // namespace scoria::analysis
