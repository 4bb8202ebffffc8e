// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/campaign.h"

#include <algorithm>
#include <set>

#include "analysis/statistics/sobol_indices.h"
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

analysis::Design MakeDesign(const DesignFile& file, const ConfigNode& node) {
  std::vector<analysis::Factor> factors;
  std::set<std::string> keys;
  for (std::size_t i = 0; i < file.factors.size(); ++i) {
    const FactorFile& f = file.factors[i];
    const ConfigNode& at = node.Find("factors")->items[i];
    const std::string path = fmt::format("sweep.factors[{}]", i);
    if (!keys.insert(f.key).second)
      throw ConfigError(at.origin, path + ".key", fmt::format("{}: is a factor already", f.key));
    if (!(f.from < f.to))
      throw ConfigError(at.origin, path + ".to", fmt::format("{} is not above {}", f.to, f.from));
    if (f.scale == analysis::FactorScale::kLog && f.from <= 0.0)
      throw ConfigError(at.origin, path + ".from", "must be above 0 on a logarithmic scale");
    factors.push_back({f.key, f.label.empty() ? f.key : f.label, f.from, f.to, f.scale});
  }
  if (factors.empty())
    throw ConfigError(node.origin, "sweep.factors", "must list at least one factor");
  const std::size_t least = analysis::PointsPerRow(factors.size());
  if (static_cast<std::size_t>(file.points) < least)
    throw ConfigError(node.origin, "sweep.points",
                      fmt::format("{} factors need at least {}", factors.size(), least));
  return analysis::MakeDesign(file.design, std::move(factors),
                              static_cast<std::size_t>(file.points), file.seed);
}

/// The design that stands in place of a list of axes, taken out of the campaign's file.
std::optional<analysis::Design> TakeDesign(ConfigNode& campaign) {
  const ConfigNode* sweep = campaign.Find("sweep");
  if (sweep == nullptr || sweep->kind != ConfigNode::Kind::kMap) return std::nullopt;
  core::ConfigContext context;
  DesignFile file;
  core::ConfigReader::Read(*sweep, "sweep", context, file);
  analysis::Design design = MakeDesign(file, *sweep);
  std::erase_if(campaign.entries, [](const ConfigNode::Entry& e) { return e.key == "sweep"; });
  return design;
}

/// What a point of the sweep changes in the scenario.
struct SweepPoint {
  std::vector<std::string> values;  // as jobs name them
  std::string name;                 // in folders
  std::vector<ConfigNode> sets;
};

/// Every combination of the axes' values.
std::vector<SweepPoint> CrossAxes(const std::vector<CampaignAxis>& axes) {
  std::vector<SweepPoint> points = {{}};
  for (const CampaignAxis& axis : axes) {
    std::vector<SweepPoint> longer;
    for (const SweepPoint& point : points) {
      for (std::size_t i = 0; i < axis.names.size(); ++i) {
        longer.push_back(point);
        longer.back().values.push_back(axis.names[i]);
        longer.back().name += "-" + axis.names[i];
        longer.back().sets.push_back(axis.sets[i]);
      }
    }
    points = std::move(longer);
  }
  return points;
}

/// @param origin  of the design, for places in messages.
std::vector<SweepPoint> PointsOf(const analysis::Design& design, const core::Origin& origin) {
  std::vector<SweepPoint> points;
  for (const std::vector<std::string>& values : design.points) {
    SweepPoint& point = points.emplace_back();
    point.values = values;
    point.name = fmt::format("-p{}", points.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      ConfigNode& set = point.sets.emplace_back();
      set.kind = ConfigNode::Kind::kMap;
      core::SetAt(set, design.factors[k].key,
                  {ConfigNode::Kind::kScalar, values[k], {}, {}, origin});
    }
  }
  return points;
}

void AddJobs(const Campaign& campaign, const CampaignArm& arm, const SweepPoint& point,
             std::vector<CampaignJob>& jobs) {
  ConfigNode node = campaign.scenario;
  if (arm.set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, arm.set);
  for (const ConfigNode& set : point.sets) {
    if (set.kind == ConfigNode::Kind::kMap) core::MergeConfig(node, set);
  }
  const Scenario read = ReadScenario(node);
  for (int k = 0; k < campaign.seeds; ++k) {
    CampaignJob job;
    job.scenario = read;
    job.arm = arm.name;
    job.point = point.values;
    job.seed = job.scenario.seed = campaign.first_seed + static_cast<std::uint64_t>(k);
    job.id = job.scenario.name =
        fmt::format("{}-s{}", core::FileNameOf(arm.name + point.name), job.seed);
    jobs.push_back(std::move(job));
  }
}

/// @param node  of the rule, for places in messages.
analysis::StopRule ToStopRule(const StopFile& file, std::size_t arms, const ConfigNode& node) {
  if (arms < 2) throw ConfigError(node.origin, "stop", "needs two arms to compare");
  std::vector<std::string> names = {"falls"};
  for (const analysis::Metric& m : analysis::AllMetrics()) names.emplace_back(m.info.key);
  if (!std::ranges::count(names, file.when_decided))
    throw ConfigError(node.Find("when_decided")->origin, "stop.when_decided",
                      fmt::format("{}: is neither falls nor a metric{}", file.when_decided,
                                  core::DidYouMean(file.when_decided, names)));
  return {file.when_decided, file.alpha};
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
  const std::vector<SweepPoint> points = campaign.design
                                             ? PointsOf(*campaign.design, campaign.design_origin)
                                             : CrossAxes(campaign.sweep);
  std::vector<CampaignJob> jobs;
  for (const CampaignArm& arm : campaign.arms) {
    for (const SweepPoint& point : points) AddJobs(campaign, arm, point, jobs);
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
  ConfigNode node = LoadKind("campaign", file, overrides);
  const core::Origin design_origin =
      node.Find("sweep") != nullptr ? node.Find("sweep")->origin : core::Origin();
  const std::optional<analysis::Design> design = TakeDesign(node);
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
  if (read.stop) campaign.stop = ToStopRule(*read.stop, read.arms.size(), *node.Find("stop"));
  campaign.design = design;
  campaign.design_origin = design_origin;
  for (const ArmFile& arm : read.arms) campaign.arms.push_back(ToArm(arm));
  const ConfigNode* sweep = node.Find("sweep");
  for (std::size_t i = 0; i < read.sweep.size(); ++i)
    campaign.sweep.push_back(MakeAxis(read.sweep[i], sweep->items[i], i));
  CheckExpected(campaign, node);
  std::set<std::string> notes;
  for (const CampaignJob& job : Plan(campaign))  // checks every scenario
    notes.insert(job.scenario.notes.begin(), job.scenario.notes.end());
  campaign.notes.assign(notes.begin(), notes.end());
  return campaign;
}

}  // namespace scoria::app
