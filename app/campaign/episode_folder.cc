// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/episode_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "analysis/report/json_text.h"
#include "app/cli/exit_codes.h"
#include "app/version.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::app {

namespace fs = std::filesystem;
using nlohmann::json;

std::optional<json> ReadResult(const fs::path& folder) {
  json result = json::parse(core::ReadText(folder / "result.json"), nullptr, false);
  const bool whole = result.is_object() && result.contains("end") && result["end"].is_string() &&
                     result.value("falls", json(0)).is_number();
  return whole ? std::optional(std::move(result)) : std::nullopt;
}

namespace {

std::string EndOf(const json& result) { return result["end"].get<std::string>(); }

/// Signals by which a program ends itself; all others come from outside.
bool IsOwnFault(int signal) {
  constexpr std::array<int, 7> kOwn = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP};
  return std::ranges::find(kOwn, signal) != kOwn.end();
}

}  // namespace

WorkerEnd Judge(const JobExit& exit, const fs::path& folder) {
  if (exit.signal) return IsOwnFault(*exit.signal) ? WorkerEnd::kCrashed : WorkerEnd::kUnfinished;
  const int code = exit.code;
  if (code == kStopped) return WorkerEnd::kUnfinished;
  if (code == kFileError) return WorkerEnd::kDiskRefused;
  if (code != kOk && code != kFailed) return WorkerEnd::kCrashed;
  if (ReadResult(folder)) return WorkerEnd::kResult;
  const bool unreadable = code == kOk || fs::exists(folder / "result.json");
  return unreadable ? WorkerEnd::kUnfinished : WorkerEnd::kCrashed;
}

std::string WordsOf(const fs::path& folder) {
  std::string words = core::ReadText(folder / "worker.txt");
  while (words.ends_with('\n')) words.pop_back();
  return words;
}

std::string WhyDiskRefused(const fs::path& folder) {
  const std::string words = WordsOf(folder);  // none: there was no room for them
  return words.empty() ? core::FileError(folder, "cannot write", ENOSPC).what() : words;
}

void WriteCrash(const fs::path& folder, const CampaignJob& job, const JobExit& exit) {
  const std::string how =
      exit.signal ? fmt::format("signal {}", *exit.signal) : fmt::format("exit code {}", exit.code);
  const std::string words = WordsOf(folder);
  const json result = {{"scenario", job.id},
                       {"seed", job.seed},
                       {"end", "crashed"},
                       {"version", kVersion},
                       {"inputs", InputHasher().Hash(job.scenario)},
                       {"how", how},
                       {"message", words.empty() ? how : how + ": " + words}};
  core::WriteText(folder / "result.json", analysis::JsonText(result));
}

std::string WhyAgain(const fs::path& folder, const CampaignJob& job, InputHasher& hasher) {
  const std::optional<json> result = ReadResult(folder);
  if (!result)
    return fs::exists(folder / "result.json") ? "the result cannot be read" : "there is no result";
  if (EndOf(*result) == "interrupted") return "interrupted";
  if (result->value("version", json()) != kVersion) return "walked by another version of scoria";
  if (core::ReadText(folder / "job.yaml") != EffectiveYaml(job.scenario))
    return "the scenario has changed";
  const json inputs = result->value("inputs", json::object());
  InputHashes before;
  for (const auto& [file, hash] : inputs.items())
    before[file] = hash.is_string() ? hash.get<std::string>() : "";
  return DescribeChange(before, hasher.Hash(job.scenario));
}

void PrepareFolder(const fs::path& folder, const CampaignJob& job) {
  constexpr std::chrono::seconds kPatience(10);  // the workers of a killed campaign are dying
  const core::FolderLock lock(folder, kPatience);
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != ".lock") fs::remove_all(entry.path());
  }
  core::WriteText(folder / "job.yaml", EffectiveYaml(job.scenario));
}

}  // namespace scoria::app
