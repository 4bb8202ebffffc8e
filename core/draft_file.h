// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace scoria::core {

/// The temporary name of a file that is being written: beside it, with ".part" at its end.
[[nodiscard]] std::filesystem::path DraftNameOf(const std::filesystem::path& path);

/// Gives a draft that is written and closed its name, when it is on the disk.
/// Errors: FileError.
void PublishDraft(const std::filesystem::path& path);

/// A file that is written piece by piece under its temporary name, and is there whole or not at
/// all.
class DraftFile {
 public:
  /// Errors, here and below: FileError, which names the file, not the draft.
  explicit DraftFile(std::filesystem::path path);
  /// Removes the draft, unless it was published.
  ~DraftFile();
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  void Append(std::string_view text);

  /// Writes what is left and gives the file its name.
  void Publish();

 private:
  void Flush();

  std::filesystem::path path_;
  std::string buffer_;
  int file_ = -1;
};

}  // namespace scoria::core
