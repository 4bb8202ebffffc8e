// SPDX-License-Identifier: BSD-3-Clause
#include "core/draft_file.h"

#include <cerrno>
#include <cstdio>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/files.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffer = 1 << 16;

}  // namespace

fs::path DraftNameOf(const fs::path& path) { return path.string() + ".part"; }

void PublishDraft(const fs::path& path) {
  const fs::path draft = DraftNameOf(path);
  const int file = open(draft.c_str(), O_RDONLY | O_CLOEXEC);
  int error = file < 0 || fsync(file) != 0 ? errno : 0;
  if (file >= 0) close(file);
  if (error == 0 && std::rename(draft.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) throw FileError(path, "cannot write", error);
}

DraftFile::DraftFile(fs::path path) : path_(std::move(path)) {
  file_ = open(DraftNameOf(path_).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) throw FileError(path_, "cannot write", errno);
  buffer_.reserve(kBuffer);
}

DraftFile::~DraftFile() {
  if (file_ < 0) return;
  close(file_);
  unlink(DraftNameOf(path_).c_str());
}

void DraftFile::Append(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= kBuffer) Flush();
}

void DraftFile::Flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t n = write(file_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw FileError(path_, "cannot write", errno);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  buffer_.clear();
}

void DraftFile::Publish() {
  Flush();
  PublishDraft(path_);
  close(std::exchange(file_, -1));
}

}  // namespace scoria::core
