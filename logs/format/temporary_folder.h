// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace scoria::logs {

/// A fresh folder of this user's alone below the system's temporary one (TMPDIR), removed with all
/// that is in it by the destructor. Files that are open by then can be read on.
class TemporaryFolder {
 public:
  /// Errors: core::FileError.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace scoria::logs
