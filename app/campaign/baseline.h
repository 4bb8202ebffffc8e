// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/study/results.h"
#include "app/campaign/campaign.h"

namespace scoria::app {

/// A campaign's folder as what another build is compared with.
struct Baseline {
  std::filesystem::path folder, file;  // file: the campaign's YAML, as it was named
  std::vector<std::string> overrides;
  std::string cpu, version;  // that walked it
  analysis::CampaignResults results;
  std::vector<std::uint64_t> seeds;  // in their order, those whose every episode has a result
};

/// Errors: std::runtime_error that names the folder and what is missing.
[[nodiscard]] Baseline LoadBaseline(const std::filesystem::path& folder);

/// Name of this computer's processor; empty where the system does not tell.
[[nodiscard]] std::string CpuName();

}  // namespace scoria::app
