// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/accept.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/config/field.h"
#include "core/text.h"

namespace scoria::app {
namespace {

/// "imu.acceleration" and "{unit: g}" of "mapping: imu.acceleration: {unit: g}".
struct Repair {
  std::string key, value;
};

std::optional<Repair> ParseRepair(const std::string& text) {
  constexpr std::string_view kStart = "mapping: ";
  if (!text.starts_with(kStart)) return std::nullopt;
  const std::size_t colon = text.find(": {", kStart.size());
  const std::size_t end = text.find('}', colon == std::string::npos ? 0 : colon);
  if (colon == std::string::npos || end == std::string::npos) return std::nullopt;
  const std::string key = text.substr(kStart.size(), colon - kStart.size());
  if (key.find(' ') != std::string::npos) return std::nullopt;  // words
  return Repair{key, text.substr(colon + 2, end - colon - 1)};
}

core::ConfigNode* NodeAt(core::ConfigNode& root, std::string_view key) {
  core::ConfigNode* node = &root;
  while (node != nullptr && !key.empty()) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    node = node->Find(key.substr(0, dot));
    key.remove_prefix(std::min(key.size(), dot + 1));
  }
  return node;
}

/// A source that is written short, as "q: position", gets its keys back.
void Lengthen(core::ConfigNode& node) {
  using Kind = core::ConfigNode::Kind;
  if (node.kind != Kind::kScalar && node.kind != Kind::kSequence) return;
  core::ConfigNode whole;
  whole.kind = Kind::kMap;
  whole.origin = node.origin;
  const char* key = node.kind == Kind::kScalar ? "field" : "fields";
  whole.entries.push_back({key, node.origin, node});
  node = std::move(whole);
}

void Apply(const Repair& repair, core::ConfigNode& mapping) {
  core::ConfigNode* node = NodeAt(mapping, repair.key);
  const bool is_source = repair.key.find('.') != std::string::npos;
  if (node != nullptr && is_source) Lengthen(*node);
  core::ApplyAssignment(mapping, repair.key + "=" + repair.value, mapping.origin);
}

void CheckNames(const std::vector<std::string>& kinds) {
  std::vector<std::string> names;
  for (const auto& [kind, name] : EnumNames(logs::FindingKind{})) names.emplace_back(name);
  for (const std::string& kind : kinds) {
    if (std::find(names.begin(), names.end(), kind) != names.end()) continue;
    throw std::runtime_error(
        fmt::format("--accept {}: is no kind of finding{}; docs/log_quality.md lists them", kind,
                    core::DidYouMean(kind, names)));
  }
}

}  // namespace

Accepted Accept(const std::vector<std::string>& kinds, const std::vector<logs::Finding>& findings,
                const logs::Mapping* mapping) {
  CheckNames(kinds);
  Accepted accepted;
  std::optional<core::ConfigNode> node;
  if (mapping != nullptr) node = mapping->node();
  bool repaired = false;
  for (const logs::Finding& finding : findings) {
    const std::string kind(core::EnumName(finding.kind));
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) continue;
    const std::optional<Repair> repair = ParseRepair(finding.repair);
    const std::string what =
        finding.signal.empty() ? kind : fmt::format("{} of {}", kind, finding.signal);
    if (repair && node) {
      Apply(*repair, *node);
      repaired = true;
      accepted.remarks.push_back(
          fmt::format("{}: accepted; read by {}: {}", what, repair->key, repair->value));
    } else if (!finding.spans.empty()) {
      accepted.left_out.insert(accepted.left_out.end(), finding.spans.begin(), finding.spans.end());
      accepted.remarks.push_back(fmt::format("{}: accepted; {} {} of time left out", what,
                                             finding.spans.size(),
                                             finding.spans.size() == 1 ? "span" : "spans"));
    } else {
      throw std::runtime_error(
          fmt::format("--accept {}: has no repair that can be made without a decision{}{}", kind,
                      finding.repair.empty() ? "" : ": ", finding.repair));
    }
  }
  if (repaired) accepted.mapping.emplace(std::move(*node));
  return accepted;
}

}  // namespace scoria::app
