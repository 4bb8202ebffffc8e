// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "core/config/node.h"

namespace scoria::core {

/// The text of a YAML file.
/// Errors: ConfigError if it cannot be read, by the place `asked_by` that names it; if it is a file
/// of another kind or too large.
[[nodiscard]] std::string ReadYamlText(const std::filesystem::path& file, const Origin& asked_by);

/// Errors: ConfigError with line, column and, where one can be seen, key if `text` is not UTF-8.
void CheckUtf8(const std::string& text, const Origin& origin);

}  // namespace scoria::core
