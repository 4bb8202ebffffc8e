// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace scoria::core {

/// Where a value was written. Line and column count from 1; line 0 means "no line", as for a
/// command-line override.
struct Origin {
  std::string file;
  int line = 0, column = 0;
  bool from_command_line = false;
  /// Folder that relative paths in the file are relative to; the working directory on the command
  /// line.
  [[nodiscard]] std::filesystem::path Folder() const;
  [[nodiscard]] std::string ToString() const;
};

/// A wrong configuration: "file:line:col: key: what is wrong and what is allowed".
class ConfigError : public std::runtime_error {
 public:
  ConfigError(const Origin& origin, std::string_view key, std::string_view rule);
};

/// A parsed YAML value that remembers where it came from, also after files were merged.
struct ConfigNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };
  struct Entry;

  Kind kind = Kind::kNull;
  std::string scalar;
  std::vector<ConfigNode> items;
  std::vector<Entry> entries;
  Origin origin;
  bool has_base = false;  // a map that named its own base: it replaces what it is laid over

  [[nodiscard]] const ConfigNode* Find(std::string_view key) const;
  [[nodiscard]] ConfigNode* Find(std::string_view key);
};

struct ConfigNode::Entry {
  std::string key;
  Origin key_origin;
  ConfigNode value;
};

/// Reads a YAML file. In any map, `base: other.yaml` (relative to the file that says so) is loaded
/// first and the map's other keys override it deeply; `<<: *anchor` merges as YAML 1.1 does, key by
/// key. Errors: ConfigError on a missing file or one of another kind, text that is not UTF-8, bad
/// YAML, a duplicate key, a circular base.
[[nodiscard]] ConfigNode LoadConfig(const std::filesystem::path& file);

/// As LoadConfig, for text; `name` stands for the file in messages and anchors relative paths.
[[nodiscard]] ConfigNode ParseConfig(const std::string& text, const std::string& name);

/// Deep merge: maps merge key by key, everything else is replaced. A map whose `type` changes is
/// replaced whole, since the keys of one variant mean nothing to another. A map of item numbers
/// merges into the items of a list.
void MergeConfig(ConfigNode& onto, const ConfigNode& over);

/// Applies one command-line override "a.b.c=value", the value in YAML.
void ApplyOverride(ConfigNode& root, const std::string& assignment);

/// As ApplyOverride, for an assignment that stands elsewhere; `origin` is named in messages.
void ApplyAssignment(ConfigNode& root, const std::string& assignment, const Origin& origin);

/// Sets the value at "a.b.c", merging as MergeConfig does; its origin stays its own.
void SetAt(ConfigNode& root, const std::string& key_path, ConfigNode value);

/// YAML text that parses to an equal tree.
[[nodiscard]] std::string EmitYaml(const ConfigNode& node);

}  // namespace scoria::core
