// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/node.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "core/config/source.h"
#include "core/text.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

Origin OriginOf(const YAML::Mark& mark, const std::string& file) {
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};  // yaml-cpp counts from 0
}

/// Lays the map, or the maps, of a merge key `<<` under the keys of `node`; the first of equals
/// counts. Source: YAML 1.1, "Merge Key Language-Independent Type".
void MergeUnder(ConfigNode& node, const ConfigNode& merged) {
  if (merged.kind == ConfigNode::Kind::kSequence) {
    for (const ConfigNode& item : merged.items) MergeUnder(node, item);
    return;
  }
  if (merged.kind != ConfigNode::Kind::kMap) {
    throw ConfigError(merged.origin, "<<",
                      "merges maps of this file, as <<: *anchor; use base: for a file");
  }
  for (const ConfigNode::Entry& entry : merged.entries) {
    if (node.Find(entry.key) == nullptr) node.entries.push_back(entry);
  }
}

/// Turns a document of yaml-cpp into our tree.
class YamlConverter {
 public:
  explicit YamlConverter(std::string file) : file_(std::move(file)) {}

  ConfigNode Convert(const YAML::Node& yaml, const std::string& path, int depth = 0) {
    ConfigNode node;
    node.origin = OriginOf(yaml.Mark(), file_);
    CheckExtent(node.origin, path, depth);
    switch (yaml.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        node.kind = ConfigNode::Kind::kScalar;
        node.scalar = yaml.Scalar();
        break;
      case YAML::NodeType::Sequence:
        node.kind = ConfigNode::Kind::kSequence;
        for (std::size_t i = 0; i < yaml.size(); ++i)
          node.items.push_back(Convert(yaml[i], fmt::format("{}[{}]", path, i), depth + 1));
        break;
      case YAML::NodeType::Map:
        node.kind = ConfigNode::Kind::kMap;
        ConvertMap(yaml, path, depth, node);
        break;
    }
    return node;
  }

 private:
  void CheckExtent(const Origin& origin, const std::string& path, int depth) {
    constexpr int kDeepest = 50, kMost = 1'000'000;
    if (depth > kDeepest)
      throw ConfigError(origin, path, "is nested too deeply or contains itself");
    if (++count_ > kMost)
      throw ConfigError(origin, path,
                        fmt::format("has more than {} values, aliases included", kMost));
  }

  void ConvertMap(const YAML::Node& yaml, const std::string& path, int depth, ConfigNode& node) {
    std::vector<ConfigNode> merged;
    for (const auto& pair : yaml) {
      const std::string key = pair.first.Scalar();
      const std::string key_path = path.empty() ? key : path + "." + key;
      const Origin key_origin = OriginOf(pair.first.Mark(), file_);
      const auto first = std::find_if(node.entries.begin(), node.entries.end(),
                                      [&](const auto& e) { return e.key == key; });
      if (first != node.entries.end()) {
        throw ConfigError(key_origin, key_path,
                          fmt::format("given twice, first in line {}", first->key_origin.line));
      }
      ConfigNode value = Convert(pair.second, key_path, depth + 1);
      if (value.origin.line == 0) value.origin = key_origin;  // an empty value has no mark
      if (key == "<<" && pair.first.Tag() == "?") {
        merged.push_back(std::move(value));
      } else {
        node.entries.push_back({key, key_origin, std::move(value)});
      }
    }
    for (const ConfigNode& under : merged) MergeUnder(node, under);
  }

  std::string file_;
  int count_ = 0;
};

/// Notes where documents begin.
class DocumentStarts final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { marks_.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
  [[nodiscard]] const std::vector<YAML::Mark>& marks() const { return marks_; }

 private:
  std::vector<YAML::Mark> marks_;
};

/// Whether there is a document. YAML::LoadAll is not used: where a text begins with a comma, it
/// sees an empty document there for ever. Errors: ConfigError if there are several, or text that
/// belongs to none.
bool HasDocument(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  DocumentStarts starts;
  while (parser.HandleNextDocument(starts)) {
    const std::vector<YAML::Mark>& marks = starts.marks();
    if (marks.size() < 2) continue;
    if (marks[0].pos == marks[1].pos)
      throw ConfigError(OriginOf(marks[0], name), "",
                        fmt::format("not valid YAML: a value does not begin with {}",
                                    Shown(text.substr(static_cast<std::size_t>(marks[0].pos), 1))));
    throw ConfigError({name, 0, 0}, "", "holds more than one YAML document");
  }
  return !starts.marks().empty();
}

ConfigNode ParseYaml(const std::string& text, const Origin& origin) {
  CheckUtf8(text, origin);
  const std::string& name = origin.file;
  try {
    if (!HasDocument(text, name)) return {};
    return YamlConverter(name).Convert(YAML::Load(text), "");
  } catch (const YAML::Exception& e) {
    throw ConfigError(OriginOf(e.mark, name), "", "not valid YAML: " + Shown(e.msg, 200));
  }
}

ConfigNode LoadWithBases(const fs::path& file, const Origin& asked_by, std::vector<fs::path> chain);

/// Replaces every map that names a `base` by the base with the map laid over it.
void ResolveBases(ConfigNode& node, const std::vector<fs::path>& chain) {
  for (ConfigNode& item : node.items) ResolveBases(item, chain);
  for (ConfigNode::Entry& entry : node.entries) ResolveBases(entry.value, chain);
  const ConfigNode* base = node.Find("base");
  if (base == nullptr) return;
  if (base->kind != ConfigNode::Kind::kScalar) {
    throw ConfigError(base->origin, "base", "must be the path of a YAML file");
  }
  const fs::path path = base->origin.Folder() / base->scalar;
  ConfigNode merged = LoadWithBases(path, base->origin, chain);
  std::erase_if(node.entries, [](const ConfigNode::Entry& e) { return e.key == "base"; });
  node.has_base = false;
  MergeConfig(merged, node);
  merged.origin = node.origin;
  merged.has_base = true;
  node = std::move(merged);
}

ConfigNode LoadWithBases(const fs::path& file, const Origin& asked_by,
                         std::vector<fs::path> chain) {
  const fs::path normal = file.lexically_normal();
  if (std::find(chain.begin(), chain.end(), normal) != chain.end()) {
    throw ConfigError(asked_by, "base", fmt::format("{} includes itself", normal.string()));
  }
  chain.push_back(normal);
  ConfigNode node = ParseYaml(ReadYamlText(normal, asked_by), {normal.string(), 0, 0});
  ResolveBases(node, chain);
  return node;
}

void SetOrigin(ConfigNode& node, const Origin& origin) {
  node.origin = origin;
  for (ConfigNode& item : node.items) SetOrigin(item, origin);
  for (ConfigNode::Entry& entry : node.entries) {
    entry.key_origin = origin;
    SetOrigin(entry.value, origin);
  }
}

bool NeedsQuotes(const std::string& s) {
  if (s.empty() || s == "~" || s == "null") return true;
  if (std::string_view("-?:,[]{}#&*!|>'\"%@` ").find(s.front()) != std::string_view::npos) {
    return !(s.front() == '-' && s.size() > 1 && (std::isdigit(s[1]) || s[1] == '.'));
  }
  return s.find_first_of("\n\"#") != std::string::npos || s.find(": ") != std::string::npos ||
         s.back() == ' ' || s.back() == ':';
}

constexpr std::size_t kLongestRule = 500;  // "known here" lists up to 350 bytes of keys

std::string OpenUnlessEmpty(std::string_view part) {
  return part.empty() ? "" : fmt::format("{}: ", part);
}

void Emit(const ConfigNode& node, YAML::Emitter& out) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      out << YAML::Null;
      break;
    case ConfigNode::Kind::kScalar:
      if (NeedsQuotes(node.scalar)) out << YAML::DoubleQuoted;
      out << node.scalar;
      break;
    case ConfigNode::Kind::kSequence: {
      const bool flat = std::all_of(node.items.begin(), node.items.end(), [](const auto& item) {
        return item.kind == ConfigNode::Kind::kScalar;
      });
      if (flat) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const ConfigNode& item : node.items) Emit(item, out);
      out << YAML::EndSeq;
      break;
    }
    case ConfigNode::Kind::kMap:
      out << YAML::BeginMap;
      for (const ConfigNode::Entry& entry : node.entries) {
        out << YAML::Key << entry.key << YAML::Value;
        Emit(entry.value, out);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

fs::path Origin::Folder() const {
  return from_command_line ? fs::path() : fs::path(file).parent_path();
}

std::string Origin::ToString() const {
  return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file;
}

ConfigError::ConfigError(const Origin& origin, std::string_view key, std::string_view rule)
    : std::runtime_error(OpenUnlessEmpty(origin.ToString()) + OpenUnlessEmpty(Shown(key, 120)) +
                         Shown(rule, kLongestRule)) {}

const ConfigNode* ConfigNode::Find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

ConfigNode* ConfigNode::Find(std::string_view key) {
  return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->Find(key));
}

ConfigNode LoadConfig(const fs::path& file) {
  return LoadWithBases(file, {file.string(), 0, 0}, {});
}

ConfigNode ParseConfig(const std::string& text, const std::string& name) {
  ConfigNode node = ParseYaml(text, {name, 0, 0});
  ResolveBases(node, {fs::path(name).lexically_normal()});
  return node;
}

namespace {

/// A map of item numbers, as the override "list.0.key=value" makes it.
bool IsIndexMap(const ConfigNode& node) {
  const auto is_index = [](const ConfigNode::Entry& entry) {
    return !entry.key.empty() && entry.key.size() < 6 &&
           std::all_of(entry.key.begin(), entry.key.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  return node.kind == ConfigNode::Kind::kMap && !node.entries.empty() &&
         std::all_of(node.entries.begin(), node.entries.end(), is_index);
}

}  // namespace

void MergeConfig(ConfigNode& onto, const ConfigNode& over) {
  using Kind = ConfigNode::Kind;
  const ConfigNode* old_type = onto.Find("type");
  const ConfigNode* new_type = over.Find("type");
  const bool other_variant =
      old_type != nullptr && new_type != nullptr && old_type->scalar != new_type->scalar;
  if (over.kind == Kind::kNull && onto.kind == Kind::kMap) {
    throw ConfigError(over.origin, "",
                      "an empty value cannot replace a section; leave the key out");
  }
  if (onto.kind == Kind::kSequence && IsIndexMap(over)) {
    for (const ConfigNode::Entry& entry : over.entries) {
      const std::size_t index = std::stoul(entry.key);
      if (index >= onto.items.size()) {
        throw ConfigError(entry.key_origin, entry.key,
                          fmt::format("the list has {} items, counted from 0", onto.items.size()));
      }
      MergeConfig(onto.items[index], entry.value);
    }
    return;
  }
  if (onto.kind != Kind::kMap || over.kind != Kind::kMap || other_variant || over.has_base) {
    onto = over;
    return;
  }
  for (const ConfigNode::Entry& entry : over.entries) {
    if (ConfigNode* value = onto.Find(entry.key)) {
      MergeConfig(*value, entry.value);
    } else {
      onto.entries.push_back(entry);
    }
  }
}

void ApplyOverride(ConfigNode& root, const std::string& assignment) {
  ApplyAssignment(root, assignment, {"--set " + Shown(assignment, 120), 0, 0, true});
}

void ApplyAssignment(ConfigNode& root, const std::string& assignment, const Origin& origin) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError(origin, "", "must read key.subkey=value");
  }
  ConfigNode value = ParseYaml(assignment.substr(equals + 1), origin);
  SetOrigin(value, origin);
  ResolveBases(value, {});
  SetAt(root, assignment.substr(0, equals), std::move(value));
}

void SetAt(ConfigNode& root, const std::string& key_path, ConfigNode value) {
  const Origin origin = value.origin;
  std::stringstream keys(key_path);
  std::vector<std::string> path;
  for (std::string key; std::getline(keys, key, '.');) path.push_back(key);
  for (auto key = path.rbegin(); key != path.rend(); ++key) {
    ConfigNode map;
    map.kind = ConfigNode::Kind::kMap;
    map.origin = origin;
    map.entries.push_back({*key, origin, std::move(value)});
    value = std::move(map);
  }
  MergeConfig(root, value);
}

std::string EmitYaml(const ConfigNode& node) {
  YAML::Emitter out;
  Emit(node, out);
  return std::string(out.c_str()) + "\n";
}

}  // namespace scoria::core
