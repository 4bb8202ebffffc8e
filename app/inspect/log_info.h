// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "logs/survey.h"

namespace scoria::app {

/// Whether `scoria info` is to open a path as a log: a folder, or a file that by its content is
/// neither a scoria YAML nor a URDF.
[[nodiscard]] bool IsTakenForLog(const std::filesystem::path& path);

/// What `scoria info LOG` shows: the log at its head, a table of topics, and what is wrong.
/// @param survey  of that log.
[[nodiscard]] std::string LogInfoText(const logs::LogSource& log, const logs::LogSurvey& survey);

/// The same as JSON. Absent numbers are null.
[[nodiscard]] nlohmann::json LogInfoJson(const logs::LogSource& log, const logs::LogSurvey& survey);

}  // namespace scoria::app
