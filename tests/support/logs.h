// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace scoria::test {

/// Copies the metadata of a log and the messages of the topics that `keep` wants.
void CopyLog(const std::filesystem::path& from, const std::filesystem::path& to,
             const std::function<bool(const std::string& topic)>& keep);

/// Whether a topic is of a group of rows that the robot's sensors cannot tell.
[[nodiscard]] bool IsTruthTopic(const std::string& topic);

}  // namespace scoria::test
