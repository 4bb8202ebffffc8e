// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scoria::core {

/// A file that the operating system refuses: "FILE: cannot write: no space left on device".
class FileError : public std::runtime_error {
 public:
  /// @param error  value of errno.
  FileError(const std::filesystem::path& file, std::string_view what, int error);
};

/// What the operating system calls an error, "no space left on device".
[[nodiscard]] std::string ErrorText(int error);

/// The whole file; empty if it cannot be read.
[[nodiscard]] std::string ReadText(const std::filesystem::path& path);

/// Writes a file whole or not at all: under a temporary name, to the disk, then renamed.
/// Errors: FileError.
void WriteText(const std::filesystem::path& path, std::string_view text);

/// Creates a folder and those above it. Errors: FileError.
void CreateFolders(const std::filesystem::path& path);

/// Hash64 of the content; none if the file cannot be read.
[[nodiscard]] std::optional<std::uint64_t> HashFile(const std::filesystem::path& path);

/// A file name for any text: everything but letters, digits, dots, dashes and underscores becomes
/// an underscore. Where that, a leading dot or dash, or the length changes the text, a hash of it
/// follows, so that other texts have other names.
[[nodiscard]] std::string FileNameOf(const std::string& text);

}  // namespace scoria::core
