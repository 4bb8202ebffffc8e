// SPDX-License-Identifier: BSD-3-Clause
#include "app/scenario/config_kinds.h"

#include <algorithm>
#include <array>

#include "app/campaign/campaign_file.h"
#include "app/scenario/scenario.h"
#include "logs/mapping/mapping_file.h"

namespace scoria::app {
namespace {

using core::ConfigNode;
using core::DescribeConfig;
using core::FieldInfo;

/// Described as a field, since it is no struct.
FieldInfo DescribeOperator() {
  OperatorParams params = RouteParams{};
  return core::ConfigDescriber::Describe(params);
}

constexpr std::array kKinds = {
    ConfigKind{"scenario", "scoria run", &DescribeConfig<Scenario>},
    ConfigKind{"campaign", "scoria campaign", &DescribeConfig<CampaignFile>},
    ConfigKind{"robot", "scoria info, robot: of a scenario", &DescribeConfig<core::RobotConfig>},
    ConfigKind{"terrain", "scoria terrain, terrain: of a scenario",
               &DescribeConfig<terrains::TerrainParams>},
    ConfigKind{"payload", "payloads: of a scenario", &DescribeConfig<sim::PayloadParams>},
    ConfigKind{"controller", "controller: of a scenario",
               &DescribeConfig<controller::ControllerParams>},
    ConfigKind{"operator", "operator: of a scenario", &DescribeOperator},
    ConfigKind{"mapping", "--mapping of a log", &DescribeConfig<logs::MappingFile>},
};

bool IsKnown(const std::vector<FieldInfo>& fields, const std::string& key) {
  return std::any_of(fields.begin(), fields.end(),
                     [&](const FieldInfo& field) { return field.key == key; });
}

/// Every key of the map is one of the struct's, and no required one is missing.
bool Fits(const ConfigNode& node, const std::vector<FieldInfo>& fields) {
  const auto is_known = [&](const ConfigNode::Entry& entry) { return IsKnown(fields, entry.key); };
  const auto is_there = [&](const FieldInfo& field) {
    return !field.required || node.Find(field.key) != nullptr;
  };
  return std::all_of(node.entries.begin(), node.entries.end(), is_known) &&
         std::all_of(fields.begin(), fields.end(), is_there);
}

/// As Fits, for one alternative of a variant.
bool FitsVariant(const ConfigNode& node, const FieldInfo& variant) {
  const ConfigNode* type = node.Find("type");
  ConfigNode rest = node;
  std::erase_if(rest.entries, [](const ConfigNode::Entry& e) { return e.key == "type"; });
  return std::any_of(variant.children.begin(), variant.children.end(),
                     [&](const FieldInfo& alternative) {
                       return type != nullptr && type->scalar == alternative.key &&
                              Fits(rest, alternative.children);
                     });
}

void RefuseOtherKind(const ConfigNode& node, std::string_view wanted) {
  const auto own = std::find_if(kKinds.begin(), kKinds.end(),
                                [&](const ConfigKind& kind) { return kind.name == wanted; });
  const FieldInfo own_info = own->describe();
  const bool all_known =
      std::all_of(node.entries.begin(), node.entries.end(),
                  [&](const auto& entry) { return IsKnown(own_info.children, entry.key); });
  if (all_known) return;  // what is missing says so itself
  for (const ConfigKind& kind : kKinds) {
    const FieldInfo info = kind.describe();
    if (info.kind != "struct" || !Fits(node, info.children)) continue;
    throw core::ConfigError({node.origin.file, 0, 0}, "",
                            fmt::format("is a {}, not a {} (for {})", kind.name, wanted, kind.use));
  }
}

}  // namespace

std::span<const ConfigKind> ConfigKinds() { return kKinds; }

std::string_view KindOf(const ConfigNode& node) {
  for (const ConfigKind& kind : kKinds) {
    const FieldInfo info = kind.describe();
    if (info.kind == "variant" ? FitsVariant(node, info) : Fits(node, info.children))
      return kind.name;
  }
  return "";
}

ConfigNode LoadKind(std::string_view kind, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides) {
  ConfigNode node = core::LoadConfig(file);
  RefuseOtherKind(node, kind);
  for (const std::string& assignment : overrides) core::ApplyOverride(node, assignment);
  return node;
}

}  // namespace scoria::app
