// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/folder_lock.h"

namespace scoria::app {

/// A folder that a run may write to, held against other processes.
struct RunFolder {
  std::filesystem::path path;
  std::unique_ptr<core::FolderLock> lock;
};

/// Takes the folder for a run. A finished run is kept: without `out` the first of PREFERRED,
/// PREFERRED-2, PREFERRED-3 ... that holds none and that no other process writes to is taken.
/// @param out    the folder that the user names, or empty.
/// @param force  overwrites the finished run in `out` or `preferred`.
/// Errors: std::runtime_error if `out` holds a finished run or a campaign; core::FolderInUse;
/// core::FileError.
[[nodiscard]] RunFolder TakeRunFolder(const std::filesystem::path& out,
                                      const std::filesystem::path& preferred, bool force);

}  // namespace scoria::app
