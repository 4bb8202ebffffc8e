// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "logs/ros/bytes.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// What the first four bytes of a message say.
struct Encapsulation {
  CdrVersion version = CdrVersion::kXcdr1;
  bool is_big_endian = false;
  bool is_delimited = false;  // structs have their size before them, unless they are final
};

/// Why bytes are no message of their type; the path grows while the walk is left.
struct CdrFault {
  std::string rule;
  std::string path;
};

/// A position in the body of a message, that is after its encapsulation.
/// Errors: CdrFault where bytes are not there or not as they must be.
class CdrCursor {
 public:
  static constexpr std::size_t kHeaderBytes = 4;

  /// Reads the encapsulation. Source: [RTPS] 10.2, [XTypes] 7.6.2.1.2; the numbers 0x10 to 0x15 of
  /// older writers: [FoxgloveCdr].
  explicit CdrCursor(std::span<const std::byte> message);

  [[nodiscard]] const Encapsulation& encapsulation() const noexcept { return encapsulation_; }
  [[nodiscard]] std::size_t position() const noexcept { return position_; }
  [[nodiscard]] std::size_t left() const noexcept { return body_.size() - position_; }
  [[nodiscard]] const std::byte* here() const noexcept { return body_.data() + position_; }

  /// Steps over the padding before a number of `size` bytes.
  void Align(std::size_t size) noexcept {
    if (encapsulation_.version == CdrVersion::kXcdr2 && size > 4) size = 4;
    position_ += (size - position_ % size) % size;  // may end beyond the body: Need finds it
  }

  /// Demands that `count` bytes are there.
  void Need(std::uint64_t count) const {
    if (position_ > body_.size() || count > left()) FailTruncated(count);
  }

  /// Aligns, and steps over `count` numbers of `size` bytes. @returns where they are.
  const std::byte* Take(std::size_t size, std::uint64_t count) {
    Align(size);
    Need(size * count);
    const std::byte* const data = here();
    position_ += size * count;
    return data;
  }

  std::uint32_t TakeUint32() {
    return LoadUnsigned<std::uint32_t>(Take(4, 1), encapsulation_.is_big_endian);
  }

  void TakeExtent(const FixedExtent& extent) {
    const std::uint64_t size = extent[position_ % 8];
    Need(size);
    position_ += size;
  }

  /// A string with length and terminator. @returns where its length is.
  const std::byte* TakeString(std::uint64_t bound);

  /// A wstring: its length in characters, then these. @returns where its length is.
  const std::byte* TakeWstring(std::uint64_t bound, int bytes_per_char);

  /// The number of elements that follow.
  /// @param smallest  bytes of an element, at least; > 0.
  std::uint32_t TakeLength(std::uint64_t bound, std::uint64_t smallest);

  /// The size that XCDR2 writes before structs and collections. @returns where what follows ends.
  std::size_t TakeDelimiter();
  void ExpectEnd(std::size_t end) const;

  [[noreturn]] void Fail(const std::string& rule) const { FailAt(position_, rule); }
  [[noreturn]] void FailAt(std::size_t position, const std::string& rule) const;

 private:
  [[noreturn]] void FailTruncated(std::uint64_t count) const;

  std::span<const std::byte> body_;
  std::size_t position_ = 0;
  Encapsulation encapsulation_;
};

}  // namespace scoria::logs
