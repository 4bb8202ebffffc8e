// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign.h"

#include <algorithm>
#include <set>

#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using core::ConfigError;
using core::ConfigNode;

/// The part of a campaign file that has a fixed form.
struct CampaignFile {
  std::string name;
  std::uint64_t first_seed = 1;
  int seeds = 3;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Field("first_seed", first_seed);
    a.Field("seeds", seeds, {.min = 1, .max = 100000});
  }
};

const ConfigNode& Require(const ConfigNode& node, const char* key) {
  const ConfigNode* child = node.Find(key);
  if (child == nullptr) throw ConfigError(node.origin, key, "is missing and has no default");
  return *child;
}

/// A name and what it changes.
CampaignArm ReadArm(const ConfigNode& node, const std::string& path) {
  CampaignArm arm;
  for (const ConfigNode::Entry& entry : node.entries) {
    if (entry.key == "name") {
      core::ConfigReader::Read(entry.value, path + ".name", arm.name);
    } else if (entry.key == "set") {
      if (entry.value.kind != ConfigNode::Kind::kMap)
        throw ConfigError(entry.value.origin, path + ".set", "must be a map of scenario keys");
      arm.set = entry.value;
    } else {
      throw ConfigError(entry.key_origin, path + "." + entry.key,
                        "unknown key; known here: name, set");
    }
  }
  if (arm.name.empty())
    throw ConfigError(node.origin, path + ".name", "is missing and has no default");
  return arm;
}

void AddValue(const ConfigNode& value, CampaignAxis& axis) {
  ConfigNode set;
  set.kind = ConfigNode::Kind::kMap;
  core::SetAt(set, axis.key, value);
  axis.sets.push_back(std::move(set));
  axis.names.push_back(value.kind == ConfigNode::Kind::kScalar ? value.scalar
                                                               : core::EmitYaml(value));
}

CampaignAxis ReadAxis(const ConfigNode& node, std::size_t index) {
  const std::string path = fmt::format("sweep[{}]", index);
  CampaignAxis axis;
  for (const ConfigNode::Entry& entry : node.entries) {
    if (entry.key == "key") {
      core::ConfigReader::Read(entry.value, path + ".key", axis.key);
    } else if (entry.key == "label") {
      core::ConfigReader::Read(entry.value, path + ".label", axis.label);
    } else if (entry.key == "baseline") {
      core::ConfigReader::Read(entry.value, path + ".baseline", axis.baseline);
    } else if (entry.key != "values" && entry.key != "variants") {
      throw ConfigError(entry.key_origin, path + "." + entry.key,
                        "unknown key; known here: key, label, baseline, values, variants");
    }
  }
  const ConfigNode *values = node.Find("values"), *variants = node.Find("variants");
  if (variants != nullptr && (values != nullptr || !axis.key.empty()))
    throw ConfigError(variants->origin, path + ".variants", "stands in place of key and values");
  if (variants != nullptr && axis.label.empty())
    throw ConfigError(node.origin, path + ".label", "is missing; variants need one");
  if (variants == nullptr && axis.key.empty())
    throw ConfigError(node.origin, path + ".key", "is missing and has no default");
  if (axis.label.empty()) axis.label = axis.key;
  const ConfigNode* list = variants != nullptr ? variants : values;
  const std::string list_path = path + (variants != nullptr ? ".variants" : ".values");
  if (list == nullptr || list->kind != ConfigNode::Kind::kSequence || list->items.empty())
    throw ConfigError(node.origin, list_path, "must list at least one");
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    if (variants == nullptr) {
      AddValue(list->items[i], axis);
      continue;
    }
    CampaignArm variant = ReadArm(list->items[i], fmt::format("{}[{}]", list_path, i));
    axis.sets.push_back(std::move(variant.set));
    axis.names.push_back(std::move(variant.name));
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
  for (int k = 0; k < campaign.seeds; ++k) {
    Scenario scenario = core::ReadConfig<Scenario>(node);
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

}  // namespace

std::vector<CampaignJob> AllJobs(const Campaign& campaign) {
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
  ConfigNode node = core::LoadConfig(file);
  for (const std::string& assignment : overrides) core::ApplyOverride(node, assignment);
  Campaign campaign;
  campaign.scenario = Require(node, "scenario");
  const ConfigNode &arms = Require(node, "arms"), *sweep = node.Find("sweep");
  for (const auto& [list, key] : {std::pair{&arms, "arms"}, std::pair{sweep, "sweep"}}) {
    if (list != nullptr && list->kind != ConfigNode::Kind::kSequence)
      throw ConfigError(list->origin, key, "must be a list, one \"- \" per entry");
  }
  for (std::size_t i = 0; i < arms.items.size(); ++i)
    campaign.arms.push_back(ReadArm(arms.items[i], fmt::format("arms[{}]", i)));
  if (campaign.arms.empty()) throw ConfigError(arms.origin, "arms", "must list at least one arm");
  for (std::size_t i = 0; sweep != nullptr && i < sweep->items.size(); ++i) {
    campaign.sweep.push_back(ReadAxis(sweep->items[i], i));
  }
  std::erase_if(node.entries, [](const ConfigNode::Entry& e) {
    return e.key == "scenario" || e.key == "arms" || e.key == "sweep";
  });
  const auto rest = core::ReadConfig<CampaignFile>(node);
  campaign.name = rest.name;
  campaign.first_seed = rest.first_seed;
  campaign.seeds = rest.seeds;
  (void)AllJobs(campaign);  // checks every scenario
  return campaign;
}

}  // namespace scoria::app
