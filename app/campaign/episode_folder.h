// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "app/campaign/executor.h"
#include "app/run/inputs.h"

namespace scoria::app {

/// The result in an episode's folder, if there is one that can be read.
[[nodiscard]] std::optional<nlohmann::json> ReadResult(const std::filesystem::path& folder);

/// What the end of a worker means for its episode.
enum class WorkerEnd { kResult, kCrashed, kUnfinished, kDiskRefused };
[[nodiscard]] WorkerEnd Judge(const JobExit& exit, const std::filesystem::path& folder);

/// What a worker said at its end.
[[nodiscard]] std::string WordsOf(const std::filesystem::path& folder);

/// What the disk refused a worker, in words.
[[nodiscard]] std::string WhyDiskRefused(const std::filesystem::path& folder);

/// A worker that died leaves its death as the episode's result.
void WriteCrash(const std::filesystem::path& folder, const CampaignJob& job, const JobExit& exit);

/// Why what stands in the folder is no result of this job, in words; empty if it is one.
[[nodiscard]] std::string WhyAgain(const std::filesystem::path& folder, const CampaignJob& job,
                                   InputHasher& hasher);

/// Empties an episode's folder once no worker of an earlier campaign writes to it any more, and
/// leaves the job there. Errors: core::FolderInUse, core::FileError.
void PrepareFolder(const std::filesystem::path& folder, const CampaignJob& job);

}  // namespace scoria::app
