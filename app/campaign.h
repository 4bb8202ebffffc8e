// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

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

/// arms x sweep x seeds over one scenario. Arms share seeds, so that they walk the same ground
/// (paired).
struct Campaign {
  std::string name;
  core::ConfigNode scenario;
  std::vector<CampaignArm> arms;
  std::vector<CampaignAxis> sweep;
  std::uint64_t first_seed = 1;
  int seeds = 3;
};

/// Errors: core::ConfigError; every episode's scenario is checked before the first one runs.
[[nodiscard]] Campaign LoadCampaign(const std::filesystem::path& file,
                                    const std::vector<std::string>& overrides);

struct CampaignOptions {
  std::filesystem::path folder;  // out/NAME by default
  int workers = 2;
  std::string program;  // the scoria executable, for the workers
  const std::atomic<bool>* interrupted = nullptr;
};

struct CampaignOutcome {
  int episodes = 0, done_before = 0, crashed = 0;
  bool interrupted = false;
};

/// Runs every episode in a worker process of its own: a crash is an outcome in the results, never
/// the end of the batch. Episodes whose result stands in the folder under the same scenario are
/// kept, so a stopped campaign resumes.
CampaignOutcome RunCampaign(const Campaign& campaign, const CampaignOptions& options);

}  // namespace scoria::app
