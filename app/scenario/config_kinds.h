// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/archive.h"

namespace scoria::app {

/// A kind of YAML file that scoria reads, whole or as the `base` of a section.
struct ConfigKind {
  std::string_view name;
  std::string_view use;  // what takes it
  core::FieldInfo (*describe)();
};

/// Scenario first.
[[nodiscard]] std::span<const ConfigKind> ConfigKinds();

/// The first kind whose keys the map has, every required one among them; empty if none.
[[nodiscard]] std::string_view KindOf(const core::ConfigNode& node);

/// Reads a file of that kind, with command-line overrides "key.sub=value".
/// Errors: core::ConfigError, also where the file is plainly one of another kind.
[[nodiscard]] core::ConfigNode LoadKind(std::string_view kind, const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides);

}  // namespace scoria::app
