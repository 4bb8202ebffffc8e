// SPDX-License-Identifier: BSD-3-Clause
#include "core/folder_lock.h"

#include <cerrno>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/files.h"

namespace scoria::core {

FolderInUse::FolderInUse(const std::filesystem::path& folder)
    : std::runtime_error(
          fmt::format("{}: another process is writing to this folder", folder.string())) {}

FolderLock::FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience) {
  CreateFolders(folder);
  const std::filesystem::path path = folder / ".lock";
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw FileError(path, "cannot create", errno);
  constexpr std::chrono::milliseconds kPause(20);
  for (;; patience -= kPause) {
    if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    if (error == ENOLCK || error == EOPNOTSUPP) return;  // a file system without locks
    if (error == EWOULDBLOCK && patience >= kPause) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    close(file_);
    if (error == EWOULDBLOCK) throw FolderInUse(folder);
    throw FileError(path, "cannot lock", error);
  }
}

FolderLock::~FolderLock() { close(file_); }

}  // namespace scoria::core
