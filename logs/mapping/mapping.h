// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/node.h"
#include "logs/mapping/mapping_file.h"
#include "logs/mapping/signal_spec.h"

namespace scoria::logs {

/// A mapping file as it was read: where the signals of a kind of log are.
class Mapping {
 public:
  /// Errors: ConfigError by file, line, column, key and rule.
  explicit Mapping(core::ConfigNode node);

  [[nodiscard]] const std::string& name() const noexcept { return file_.name; }
  [[nodiscard]] const MappingFile& file() const noexcept { return file_; }
  [[nodiscard]] const core::ConfigNode& node() const noexcept { return node_; }  // as it was read
  [[nodiscard]] const std::vector<SignalSpec>& signals() const noexcept { return signals_; }

  /// A wrong key of this mapping, found when a log was held against it.
  [[nodiscard]] core::ConfigError ErrorAt(std::string_view key, std::string_view rule) const;

 private:
  core::ConfigNode node_;
  MappingFile file_;
  std::vector<SignalSpec> signals_;
};

/// Errors: as Mapping and core::LoadConfig have them.
[[nodiscard]] Mapping LoadMapping(const std::filesystem::path& file);

/// @param name  stands for the file in messages.
[[nodiscard]] Mapping ParseMapping(const std::string& text, const std::string& name);

/// The mappings that scoria brings along, those of the folder mappings, by name.
[[nodiscard]] const std::vector<Mapping>& ShippedMappings();

/// The shipped mapping of that name, else the file.
/// Errors: ConfigError, with the names that there are if it is neither.
[[nodiscard]] Mapping FindMapping(const std::string& name_or_file);

}  // namespace scoria::logs
