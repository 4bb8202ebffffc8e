// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/study/design.h"
#include "analysis/study/stopping.h"
#include "app/scenario/scenario.h"
#include "core/config/archive.h"

namespace scoria::app {

/// One thing to compare: a name and what it changes in the scenario.
struct CampaignArm {
  std::string name;
  core::ConfigNode set;
};

/// One swept key of the scenario, or variants of several keys; the arms cross them.
struct CampaignAxis {
  std::string key, label;              // a list of variants has its label for a key
  std::vector<core::ConfigNode> sets;  // what each value changes in the scenario
  std::vector<std::string> names;      // of the values, as the file writes them
  std::string baseline;                // name that the report compares the others with, or empty
};

/// arms x sweep x seeds over one scenario; in place of a sweep there may be a design. Arms share
/// seeds, so that they walk the same ground (paired).
struct Campaign {
  std::string name;
  std::filesystem::path file;          // that it was read from, as it was named
  std::vector<std::string> overrides;  // of the command line
  core::ConfigNode scenario;
  std::vector<CampaignArm> arms;
  std::vector<CampaignAxis> sweep;
  std::optional<analysis::Design> design;
  core::Origin design_origin;  // in the campaign's file
  std::uint64_t first_seed = 1;
  int seeds = 3;
  std::optional<analysis::StopRule> stop;  // ends it before the seeds are spent
  ArmExpectations expect;
  core::ConfigNotes notes;  // about the scenarios' texts
};

/// Errors: core::ConfigError; every episode's scenario is checked before the first one runs.
[[nodiscard]] Campaign LoadCampaign(const std::filesystem::path& file,
                                    const std::vector<std::string>& overrides);

/// One episode of a campaign.
struct CampaignJob {
  std::string id, arm;             // id: its folder's name
  std::vector<std::string> point;  // value per axis, or per factor
  std::uint64_t seed = 0;
  Scenario scenario;
};

/// Every combination of arms, values and seeds.
/// Errors: core::ConfigError if a scenario is wrong or two episodes have one name.
[[nodiscard]] std::vector<CampaignJob> Plan(const Campaign& campaign);

struct CampaignOptions {
  std::filesystem::path folder;  // out/NAME by default
  int workers = 2;
  std::string program;  // the scoria executable, for the workers
  const std::atomic<bool>* interrupted = nullptr;
  /// Why episodes that an earlier campaign left in the folder are walked again, and how many.
  std::function<void(const std::string& reason, int episodes)> on_again;
};

struct CampaignOutcome {
  int episodes = 0;  // of the seeds up to the last that was needed
  int done_before = 0, crashed = 0;
  int failed = 0;      // ended non_finite or hardly walked
  int unfinished = 0;  // to be walked by the same command again
  bool interrupted = false;
  std::optional<analysis::StopRecord> stop;  // of a campaign that may stop by itself
  std::string disk_problem;  // why the campaign ended early, if the disk refused a file
};

/// Writes campaign.json: what the folder of a campaign holds. Errors: core::FileError.
/// @param stop  of a campaign that may stop by itself; the index then ends with its last seed.
void WriteIndex(const Campaign& campaign, const std::vector<CampaignJob>& jobs,
                const std::filesystem::path& folder,
                const std::optional<analysis::StopRecord>& stop = std::nullopt);

/// Runs every episode in a worker process of its own: a crash is an outcome in the results, never
/// the end of the batch. Episodes whose result stands in the folder, of the same version and
/// scenario and of files with the same content, are kept, so a stopped campaign resumes. What was
/// killed from outside, ran out of space or left an unreadable result is walked by the next one.
/// With a stop rule, seeds are looked at in their order, each once all its episodes have ended: the
/// last one does not depend on the workers. Episodes of later seeds that were walked meanwhile stay
/// in the folder, but are not in its index.
/// Errors: core::FolderInUse; core::FileError if the disk refuses the campaign's own folder.
CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options);

}  // namespace scoria::app
