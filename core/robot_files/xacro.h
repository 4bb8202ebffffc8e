// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace scoria::core {

/// The URDF that the program `xacro` makes of a file.
/// Errors: ConfigError if the program is not installed, or with the end of what it complains of.
[[nodiscard]] std::string ExpandXacro(const std::filesystem::path& file);

}  // namespace scoria::core
