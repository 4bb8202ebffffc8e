// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/random_access_file.h"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/files.h"

namespace scoria::logs {

RandomAccessFile::RandomAccessFile(const std::filesystem::path& path, std::filesystem::path shown)
    : shown_(std::move(shown)), file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0) throw core::FileError(shown_, "cannot read the file", errno);
  struct stat status {};
  if (fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(file_);
    throw core::FileError(shown_, "is not a regular file", 0);
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

RandomAccessFile::~RandomAccessFile() { close(file_); }

Bytes RandomAccessFile::Read(std::uint64_t offset, std::uint64_t size) const {
  Bytes bytes(static_cast<std::size_t>(std::min(size, Rest(offset))));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n =
        pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw core::FileError(shown_, "cannot read the file", errno);
    if (n == 0) break;  // it was cut while it was open
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

std::span<const std::byte> FileWindow::At(std::uint64_t offset, std::uint64_t size) {
  constexpr std::uint64_t kLeast = 64 << 10;
  size = std::min(size, file_.Rest(offset));
  const bool is_inside = offset >= start_ && offset + size <= start_ + bytes_.size();
  if (!is_inside) {
    bytes_ = file_.Read(offset, std::max(size, kLeast));
    start_ = offset;
  }
  const std::span<const std::byte> from = std::span<const std::byte>(bytes_).subspan(
      static_cast<std::size_t>(std::min<std::uint64_t>(offset - start_, bytes_.size())));
  return from.first(static_cast<std::size_t>(std::min<std::uint64_t>(size, from.size())));
}

}  // namespace scoria::logs
