// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "logs/format/random_access_file.h"

namespace scoria::logs {

/// Reads a text file line by line, of whatever size. A byte order mark is left out.
class LineReader {
 public:
  static constexpr std::size_t kLongest = 16 << 20;  // bytes of a line

  /// `file` is borrowed.
  explicit LineReader(const RandomAccessFile& file) : file_(file) {}

  /// The next line without its end, until the next call; nothing at the end of the file, and where
  /// a line is too long. Errors: core::FileError.
  [[nodiscard]] std::optional<std::string_view> Next();

  [[nodiscard]] std::uint64_t number() const { return number_; }  // of the last line, from 1
  [[nodiscard]] bool IsAtEnd() const { return start_ == block_.size() && offset_ >= file_.size(); }
  [[nodiscard]] bool has_too_long_line() const { return has_too_long_line_; }

 private:
  /// Makes more of the file follow what is not read yet. @returns false at its end.
  bool ReadMore();

  const RandomAccessFile& file_;
  Bytes block_;
  std::size_t start_ = 0;     // in block_: of what is not read yet
  std::uint64_t offset_ = 0;  // in the file: of what follows block_
  std::uint64_t number_ = 0;
  bool has_too_long_line_ = false;
};

}  // namespace scoria::logs
