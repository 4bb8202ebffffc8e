// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>

namespace scoria::core {

/// Another process writes to the folder.
class FolderInUse : public std::runtime_error {
 public:
  explicit FolderInUse(const std::filesystem::path& folder);
};

/// Holds a folder for one process by a lock on its file `.lock`. The lock ends with the process,
/// however that ends; the file stays.
class FolderLock {
 public:
  /// Creates the folder if need be.
  /// @param patience  how long to wait for another process to end.
  /// Errors: FolderInUse, FileError.
  explicit FolderLock(const std::filesystem::path& folder,
                      std::chrono::milliseconds patience = std::chrono::milliseconds(0));
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace scoria::core
