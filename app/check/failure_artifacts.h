// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "logs/read_rows.h"

namespace scoria::app {

/// What shows a failure.
struct FailureArtifacts {
  std::vector<std::filesystem::path> files;  // log.mcap, time_moment.png, moment.mp4
  std::string problem;                       // why some are missing, in words
};

/// The moment that a failed walk is best seen at, s: the first fall; without one, when the trunk
/// was tilted most. @pre log.rows is not empty.
[[nodiscard]] double FindMoment(const logs::LogContent& log);

/// A clip and a figure of the moment, beside the log in an episode's folder.
[[nodiscard]] FailureArtifacts MakeFailureArtifacts(const std::filesystem::path& folder);

}  // namespace scoria::app
