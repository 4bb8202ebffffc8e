// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/campaign/campaign.h"

namespace scoria::app {

/// A scenario or campaign as a test.
struct CheckTest {
  std::string name;  // path below the folder that was named, without extension
  std::filesystem::path file;
  std::optional<Campaign> campaign;
  std::vector<CampaignJob> jobs;   // a scenario's is one; they keep no logs
  std::vector<std::string> unfit;  // overrides that it does not take
};

/// One of `of` parts, counted from 1.
struct Shard {
  int part = 1, of = 1;
};

struct CheckSelection {
  std::vector<std::filesystem::path> paths;  // folders, with all below them, and files
  std::vector<std::string> overrides;        // of scenario keys
  Shard shard;
};

struct FoundTests {
  std::vector<CheckTest> tests;        // by name
  std::vector<std::string> not_tests;  // YAML of other kinds, in words
};

/// Every scenario and campaign there. An override holds for the tests that take it, and is an error
/// if none does: keys of one variant mean nothing to another.
/// Errors: core::ConfigError, std::runtime_error if there is no test, or two of one name.
[[nodiscard]] FoundTests FindTests(const CheckSelection& selection);

}  // namespace scoria::app
