// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/campaign.h"

#include <algorithm>
#include <set>

#include "app/campaign/campaign_file.h"
#include "app/scenario/config_kinds.h"
#include "app/scenario/observable.h"
#include "core/files.h"
#include "core/text.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using core::ConfigError;
using core::ConfigNode;

CampaignArm ToArm(const ArmFile& file) { return {file.name, file.set.node}; }

void AddValue(const ConfigNode& value, CampaignAxis& axis) {
  ConfigNode set;
  set.kind = ConfigNode::Kind::kMap;
  core::SetAt(set, axis.key, value);
  axis.sets.push_back(std::move(set));
  axis.names.push_back(value.kind == ConfigNode::Kind::kScalar ? value.scalar
                                                               : core::EmitYaml(value));
}

/// @param node  of the axis, for places in messages.
CampaignAxis MakeAxis(const AxisFile& file, const ConfigNode& node, std::size_t index) {
  const std::string path = fmt::format("sweep[{}]", index);
  CampaignAxis axis{file.key, file.label, {}, {}, file.baseline};
  const ConfigNode *values = node.Find("values"), *variants = node.Find("variants");
  if (variants != nullptr && (values != nullptr || !axis.key.empty()))
    throw ConfigError(variants->origin, path + ".variants", "stands in place of key and values");
  if (variants != nullptr && axis.label.empty())
    throw ConfigError(node.origin, path + ".label", "is missing; variants need one");
  if (variants == nullptr && axis.key.empty())
    throw ConfigError(node.origin, path + ".key", "is missing and has no default");
  if (axis.label.empty()) axis.label = axis.key;
  if (file.values.empty() && file.variants.empty())
    throw ConfigError(node.origin, path + (variants != nullptr ? ".variants" : ".values"),
                      "must list at least one");
  for (const ConfigNode& value : file.values) AddValue(value, axis);
  for (const ArmFile& variant : file.variants) {
    axis.sets.push_back(variant.set.node);
    axis.names.push_back(variant.name);
  }
  if (axis.key.empty()) axis.key = axis.label;
  if (!axis.baseline.empty() && !std::ranges::count(axis.names, axis.baseline))
    throw ConfigError(node.Find("baseline")->origin, path + ".baseline",
                      fmt::format("{}: is none of the {}", axis.baseline,
                                  variants != nullptr ? "variants" : "values"));
  return axis;
}

/// Every combination of the axes' values, by index.
void AddJobs(const Campaign& campaign, const CampaignArm& arm, std::vector<std::size_t>& point,
             std::vector<CampaignJob>& jobs) {
  if (point.size() < campaign.sweep.size()) {
    for (std::size_t i = 0; i < campaign.sweep[point.size()].names.size(); ++i) {
      point.push_back(i);
      AddJobs(campaign, arm, point, jobs);
      point.pop_back();
    }
    return;
  }
  ConfigNode node = campaign.scenario;
  if (arm.set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, arm.set);
  for (std::size_t i = 0; i < point.size(); ++i) {
    const ConfigNode& set = campaign.sweep[i].sets[point[i]];
    if (set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, set);
  }
  const Scenario read = ReadScenario(node);
  for (int k = 0; k < campaign.seeds; ++k) {
    Scenario scenario = read;
    CampaignJob job;
    job.arm = arm.name;
    job.seed = scenario.seed = campaign.first_seed + static_cast<std::uint64_t>(k);
    std::string name = arm.name;
    for (std::size_t i = 0; i < point.size(); ++i) {
      job.point.push_back(campaign.sweep[i].names[point[i]]);
      name += "-" + job.point.back();
    }
    job.id = scenario.name = fmt::format("{}-s{}", core::FileNameOf(name), job.seed);
    job.scenario = std::move(scenario);
    jobs.push_back(std::move(job));
  }
}

/// Errors: core::ConfigError if an expectation is of an arm that there is not, or is a ratio of
/// something other than falls.
void CheckExpected(const Campaign& campaign, const ConfigNode& node) {
  std::vector<std::string> names;
  for (const CampaignArm& arm : campaign.arms) names.push_back(arm.name);
  CheckExpectedNames(node);
  for (const auto& [name, bounds] : campaign.expect) {
    const core::Origin& origin = node.Find("expect")->Find(name)->origin;
    const std::string path = "expect." + name;
    std::vector<std::string> named = bounds.arms;
    for (const ArmComparison& c : bounds.compare) {
      named.insert(named.end(), {c.of, c.to});
      if ((c.ratio_below || c.ratio_above) && !IsFallRate(name))
        throw ConfigError(origin, path, "only falls and falls_per_m have ratios");
      if ((c.difference_below || c.difference_above) && !IsMetric(name))
        throw ConfigError(origin, path, "only metrics have differences");
    }
    for (const std::string& arm : named) {
      if (!std::ranges::count(names, arm))
        throw ConfigError(
            origin, path,
            fmt::format("{} is none of the arms{}", arm, core::DidYouMean(arm, names)));
    }
  }
}

}  // namespace

std::vector<CampaignJob> Plan(const Campaign& campaign) {
  std::vector<CampaignJob> jobs;
  for (const CampaignArm& arm : campaign.arms) {
    std::vector<std::size_t> point;
    AddJobs(campaign, arm, point, jobs);
  }
  std::set<std::string> ids;
  for (const CampaignJob& job : jobs) {
    if (!ids.insert(job.id).second) {
      throw ConfigError(
          campaign.scenario.origin, "arms, sweep",
          fmt::format("two episodes would share the folder {}; give arms and values distinct names",
                      job.id));
    }
  }
  return jobs;
}

Campaign LoadCampaign(const fs::path& file, const std::vector<std::string>& overrides) {
  const ConfigNode node = LoadKind("campaign", file, overrides);
  const auto read = core::ReadConfig<CampaignFile>(node);
  if (read.arms.empty())
    throw ConfigError(node.Find("arms")->origin, "arms", "must list at least one arm");
  Campaign campaign;
  campaign.name = read.name;
  campaign.file = file;
  campaign.overrides = overrides;
  campaign.scenario = read.scenario.node;
  campaign.first_seed = read.first_seed;
  campaign.seeds = read.seeds;
  campaign.expect = read.expect;
  for (const ArmFile& arm : read.arms) campaign.arms.push_back(ToArm(arm));
  for (std::size_t i = 0; i < read.sweep.size(); ++i)
    campaign.sweep.push_back(MakeAxis(read.sweep[i], node.Find("sweep")->items[i], i));
  CheckExpected(campaign, node);
  std::set<std::string> notes;
  for (const CampaignJob& job : Plan(campaign))  // checks every scenario
    notes.insert(job.scenario.notes.begin(), job.scenario.notes.end());
  campaign.notes.assign(notes.begin(), notes.end());
  return campaign;
}

}  // namespace scoria::app
