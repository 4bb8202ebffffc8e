// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/mapping.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "core/config/archive.h"
#include "core/text.h"
#include "logs/mapping/embedded_mappings.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// The node of a key such as "joints.q.field", or the nearest above that is there.
const core::ConfigNode& NodeAt(const core::ConfigNode& root, std::string_view key) {
  const core::ConfigNode* node = &root;
  while (!key.empty()) {
    const std::size_t dot = std::min(key.find('.'), key.size());
    const core::ConfigNode* child = node->Find(key.substr(0, dot));
    if (child == nullptr) break;
    node = child;
    key.remove_prefix(std::min(key.size(), dot + 1));
  }
  return *node;
}

}  // namespace

Mapping::Mapping(core::ConfigNode node)
    : node_(std::move(node)), file_(core::ReadConfig<MappingFile>(node_)) {
  if (file_.name.empty()) file_.name = fs::path(node_.origin.file).stem().string();
  if (const auto problem = FindProblem(file_)) throw ErrorAt(problem->key, problem->rule);
  signals_ = ListSignals(file_);
}

core::ConfigError Mapping::ErrorAt(std::string_view key, std::string_view rule) const {
  return {NodeAt(node_, key).origin, key, rule};
}

Mapping LoadMapping(const fs::path& file) { return Mapping(core::LoadConfig(file)); }

Mapping ParseMapping(const std::string& text, const std::string& name) {
  return Mapping(core::ParseConfig(text, name));
}

const std::vector<Mapping>& ShippedMappings() {
  static const std::vector<Mapping> kMappings = [] {
    std::vector<Mapping> mappings;
    for (const EmbeddedText& file : EmbeddedMappings())
      mappings.push_back(
          ParseMapping(std::string(file.text), "mappings/" + std::string(file.name)));
    return mappings;
  }();
  return kMappings;
}

Mapping FindMapping(const std::string& name_or_file) {
  std::vector<std::string> names;
  for (const Mapping& mapping : ShippedMappings()) {
    if (mapping.name() == name_or_file) return mapping;
    names.push_back(mapping.name());
  }
  if (fs::exists(name_or_file)) return LoadMapping(name_or_file);
  std::string hint = core::DidYouMean(name_or_file, names);
  if (hint.empty()) hint = fmt::format("; shipped: {}", fmt::join(names, ", "));
  throw core::ConfigError({name_or_file, 0, 0}, "",
                          "is neither a file nor a shipped mapping" + hint);
}

}  // namespace scoria::logs
