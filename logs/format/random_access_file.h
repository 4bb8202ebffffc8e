// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "logs/format/bytes.h"

namespace scoria::logs {

/// A file that is read at any place. Its size is that of the moment when it was opened.
class RandomAccessFile {
 public:
  /// Errors, here and below: core::FileError.
  explicit RandomAccessFile(const std::filesystem::path& path) : RandomAccessFile(path, path) {}
  /// `shown` stands for the file in messages.
  RandomAccessFile(const std::filesystem::path& path, std::filesystem::path shown);
  ~RandomAccessFile();
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return shown_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t Rest(std::uint64_t offset) const {
    return offset < size_ ? size_ - offset : 0;
  }

  /// As many of the bytes as the file has.
  [[nodiscard]] Bytes Read(std::uint64_t offset, std::uint64_t size) const;

 private:
  std::filesystem::path shown_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

/// Many small reads of a file that mostly go forward.
class FileWindow {
 public:
  /// `file` is borrowed.
  explicit FileWindow(const RandomAccessFile& file) : file_(file) {}

  /// As many of the bytes as the file has; until the next call.
  [[nodiscard]] std::span<const std::byte> At(std::uint64_t offset, std::uint64_t size);

 private:
  const RandomAccessFile& file_;
  std::uint64_t start_ = 0;
  Bytes bytes_;
};

}  // namespace scoria::logs
