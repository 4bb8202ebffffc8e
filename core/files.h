// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace scoria::core {

/// The whole file; empty if it cannot be read.
[[nodiscard]] std::string ReadText(const std::filesystem::path& path);

/// Errors: std::runtime_error that names the file.
void WriteText(const std::filesystem::path& path, const std::string& text);

/// `text` with everything but letters, digits, dots and dashes replaced by underscores.
[[nodiscard]] std::string FileNameOf(std::string text);

}  // namespace scoria::core
