// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/cdr_cursor.h"

#include <fmt/format.h>

namespace scoria::logs {
namespace {

Encapsulation ReadEncapsulation(std::span<const std::byte> message) {
  if (message.size() < CdrCursor::kHeaderBytes) {
    throw CdrFault{fmt::format("{} bytes are too few for an encapsulation (4)", message.size()),
                   ""};
  }
  const auto id = LoadUnsigned<std::uint16_t>(message.data(), true);
  const bool big = id % 2 == 0;
  switch (id & ~1u) {
    case 0x00:
      return {CdrVersion::kXcdr1, big, false};
    case 0x06:
    case 0x10:
      return {CdrVersion::kXcdr2, big, false};
    case 0x08:
    case 0x14:
      return {CdrVersion::kXcdr2, big, true};
    case 0x02:
    case 0x0a:
    case 0x12:
      throw CdrFault{fmt::format("encapsulation 0x{:04x} is a parameter list (PL_CDR, mutable "
                                 "types), which is not decoded",
                                 id),
                     ""};
    default:
      throw CdrFault{fmt::format("encapsulation 0x{:04x} is not CDR", id), ""};
  }
}

}  // namespace

CdrCursor::CdrCursor(std::span<const std::byte> message)
    : encapsulation_(ReadEncapsulation(message)) {
  body_ = message.subspan(kHeaderBytes);
}

void CdrCursor::FailAt(std::size_t position, const std::string& rule) const {
  throw CdrFault{fmt::format("{} (at byte {} of {})", rule, position + kHeaderBytes,
                             body_.size() + kHeaderBytes),
                 ""};
}

void CdrCursor::FailTruncated(std::uint64_t count) const {
  Fail(fmt::format("{} bytes are needed, {} are left", count,
                   position_ > body_.size() ? 0 : left()));
}

const std::byte* CdrCursor::TakeString(std::uint64_t bound) {
  const std::uint32_t length = TakeUint32();
  const std::byte* const start = here() - 4;
  if (length > left()) Fail(fmt::format("a string of {} bytes, {} are left", length, left()));
  if (length == 0) return start;  // some writers leave out the terminator of an empty string
  if (start[4 + length - 1] != std::byte{0}) Fail("a string without a zero byte at its end");
  if (bound > 0 && length - 1 > bound) {
    Fail(fmt::format("a string of {} characters, at most {} are allowed", length - 1, bound));
  }
  position_ += length;
  return start;
}

const std::byte* CdrCursor::TakeWstring(std::uint64_t bound, int bytes_per_char) {
  const std::uint32_t length = TakeUint32();
  const std::byte* const start = here() - 4;
  const std::uint64_t bytes = std::uint64_t{length} * static_cast<std::uint64_t>(bytes_per_char);
  if (bytes > left()) {
    Fail(fmt::format("a wstring of {} {}-byte characters, {} bytes are left", length,
                     bytes_per_char, left()));
  }
  if (bound > 0 && length > bound) {
    Fail(fmt::format("a wstring of {} characters, at most {} are allowed", length, bound));
  }
  position_ += bytes;
  return start;
}

std::uint32_t CdrCursor::TakeLength(std::uint64_t bound, std::uint64_t smallest) {
  const std::uint32_t length = TakeUint32();
  if (bound > 0 && length > bound) {
    Fail(fmt::format("{} elements, at most {} are allowed", length, bound));
  }
  if (length > left() / smallest) {
    Fail(fmt::format("{} elements of at least {} bytes, {} bytes are left", length, smallest,
                     left()));
  }
  return length;
}

std::size_t CdrCursor::TakeDelimiter() {
  const std::uint32_t size = TakeUint32();
  if (size > left()) Fail(fmt::format("a delimiter says {} bytes, {} are left", size, left()));
  return position_ + size;
}

void CdrCursor::ExpectEnd(std::size_t end) const {
  if (position_ != end) {
    Fail(fmt::format("its delimiter says that it ends at byte {}", end + kHeaderBytes));
  }
}

}  // namespace scoria::logs
