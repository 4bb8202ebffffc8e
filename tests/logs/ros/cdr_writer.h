// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scoria::test {

/// Writes CDR byte by byte, for tests of the reader: nothing of it is shared with that.
class CdrWriter {
 public:
  /// @param id  of the encapsulation, such as 0x0001 for little-endian XCDR1.
  explicit CdrWriter(int id)
      : big_(id % 2 == 0), xcdr2_(id >= 0x06), delimited_((id & ~1) == 0x08 || (id & ~1) == 0x14) {
    Byte(id >> 8);
    Byte(id & 0xff);
    Byte(0);
    Byte(0);
  }

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] bool is_xcdr2() const { return xcdr2_; }
  [[nodiscard]] bool is_delimited() const { return delimited_; }

  CdrWriter& Unsigned(std::uint64_t value, std::size_t size) {
    Align(size);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t shift = 8 * (big_ ? size - 1 - i : i);
      Byte(static_cast<int>(value >> shift & 0xff));
    }
    return *this;
  }
  CdrWriter& U8(std::uint64_t value) { return Unsigned(value, 1); }
  CdrWriter& U16(std::uint64_t value) { return Unsigned(value, 2); }
  CdrWriter& U32(std::uint64_t value) { return Unsigned(value, 4); }
  CdrWriter& U64(std::uint64_t value) { return Unsigned(value, 8); }
  CdrWriter& F32(float value) { return U32(std::bit_cast<std::uint32_t>(value)); }
  CdrWriter& F64(double value) { return U64(std::bit_cast<std::uint64_t>(value)); }
  CdrWriter& Text(const std::string& text) {
    U32(text.size() + 1);
    for (const char c : text) Byte(c);
    Byte(0);
    return *this;
  }
  CdrWriter& WideText(const std::u32string& text, std::size_t bytes_per_char) {
    U32(text.size());
    for (const char32_t c : text) Unsigned(c, bytes_per_char);
    return *this;
  }
  CdrWriter& Bytes(int value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) Byte(value);
    return *this;
  }

  /// Leaves room for a size and returns where; EndSized fills it in.
  std::size_t BeginSized() {
    U32(0);
    return bytes_.size();
  }
  void EndSized(std::size_t begin) {
    const std::uint64_t size = bytes_.size() - begin;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes_[begin - 4 + i] = static_cast<std::byte>(size >> 8 * (big_ ? 3 - i : i) & 0xff);
    }
  }

 private:
  void Byte(int value) { bytes_.push_back(static_cast<std::byte>(value)); }
  void Align(std::size_t size) {
    const std::size_t to = xcdr2_ && size == 8 ? 4 : size;
    while ((bytes_.size() - 4) % to != 0) Byte(0);
  }

  bool big_, xcdr2_, delimited_;
  std::vector<std::byte> bytes_;
};

}  // namespace scoria::test
