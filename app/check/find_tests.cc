// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/find_tests.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "app/scenario/config_kinds.h"
#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using core::ConfigError;

/// Name of a test, and its file.
using TestFiles = std::map<std::string, fs::path>;

void AddFile(const fs::path& file, const fs::path& below, TestFiles& files) {
  const std::string name = file.lexically_relative(below).replace_extension().generic_string();
  if (!files.try_emplace(name, file).second && files[name] != file)
    throw std::runtime_error(fmt::format("two tests are named {}: {} and {}", name,
                                         files[name].string(), file.string()));
}

TestFiles FindFiles(const std::vector<fs::path>& paths) {
  TestFiles files;
  for (const fs::path& path : paths) {
    const fs::path normal = path.lexically_normal();
    if (!fs::is_directory(normal)) {
      AddFile(normal, normal.parent_path(), files);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(normal)) {
      if (entry.path().extension() == ".yaml") AddFile(entry.path(), normal, files);
    }
  }
  return files;
}

/// A scenario, or the episodes of a campaign.
CheckTest LoadTest(const std::string& name, const fs::path& file, bool is_campaign,
                   const std::vector<std::string>& overrides) {
  CheckTest test{.name = name, .file = file, .campaign = {}, .jobs = {}, .unfit = {}};
  if (is_campaign) {
    std::vector<std::string> of_scenario;
    for (const std::string& o : overrides) of_scenario.push_back("scenario." + o);
    test.campaign = LoadCampaign(file, of_scenario);
    test.jobs = Plan(*test.campaign);
  } else {
    CampaignJob& job = test.jobs.emplace_back();
    job.scenario = LoadScenario(file, overrides);
    job.id = job.arm = job.scenario.name;
    job.seed = job.scenario.seed;
  }
  for (CampaignJob& job : test.jobs) job.scenario.log.keep = KeepLog::kMetrics;
  return test;
}

/// Overrides, and which test took them.
class Overrides {
 public:
  explicit Overrides(std::vector<std::string> all) : all_(std::move(all)) {}

  /// The test with those that it takes.
  CheckTest Load(const std::string& name, const fs::path& file, bool is_campaign) {
    std::vector<std::string> fit, unfit;
    if (!all_.empty()) (void)LoadTest(name, file, is_campaign, {});  // its own mistakes first
    for (const std::string& o : all_) {
      try {
        fit.push_back(o);
        (void)LoadTest(name, file, is_campaign, fit);
        taken_.insert(o);
      } catch (const ConfigError& e) {
        fit.pop_back();
        unfit.push_back(o);
        refused_.try_emplace(o, e.what());
      }
    }
    CheckTest test = LoadTest(name, file, is_campaign, fit);
    test.unfit = std::move(unfit);
    return test;
  }

  void DemandAllTaken() const {
    for (const std::string& o : all_) {
      if (!taken_.contains(o)) throw std::runtime_error(refused_.at(o));
    }
  }

 private:
  std::vector<std::string> all_;
  std::set<std::string> taken_;
  std::map<std::string, std::string> refused_;  // why
};

}  // namespace

FoundTests FindTests(const CheckSelection& selection) {
  FoundTests found;
  Overrides overrides(selection.overrides);
  int number = 0;
  for (const auto& [name, file] : FindFiles(selection.paths)) {
    const core::ConfigNode node = core::LoadConfig(file);
    const std::string_view kind = KindOf(node);
    const bool is_campaign = node.Find("arms") != nullptr;
    if (!kind.empty() && kind != "scenario" && kind != "campaign") {
      found.not_tests.push_back(fmt::format("{} is a {}", file.string(), kind));
      continue;
    }
    CheckTest test = overrides.Load(name, file, is_campaign);
    if (number++ % selection.shard.of + 1 == selection.shard.part)
      found.tests.push_back(std::move(test));
  }
  if (number == 0) throw std::runtime_error("there is no scenario and no campaign to check");
  overrides.DemandAllTaken();
  return found;
}

}  // namespace scoria::app
