// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "logs/format/bag_files.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// The files of a bag as one log: messages of all of them in the order of time, also where the
/// spans of files overlap. Channels of the same topic, type, definition and encoding are one.
/// Where metadata.yaml says something else than the files, they count and that is a problem.
/// @param path   as it was opened.
/// @param bag    where the parts are from; its files are not looked at.
/// @param parts  at least one.
[[nodiscard]] std::unique_ptr<LogSource> JoinBag(const std::filesystem::path& path,
                                                 const BagFiles& bag,
                                                 std::vector<std::unique_ptr<LogSource>> parts);

}  // namespace scoria::logs
