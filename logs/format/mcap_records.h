// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/format/mcap_format.h"

/// The records of MCAP that the reader needs, out of their bytes. Bytes beyond the fields that a
/// record is known to have are left alone, as the specification asks. Source: [MCAP], "Records".
namespace scoria::logs::mcap_format {

/// A record whose bytes end within a field, or are at odds with each other.
class RecordError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Takes little-endian values off the front. Errors: RecordError at the end of the data.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T Int() {
    const auto raw = Raw(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      value |= static_cast<std::uint64_t>(raw[i]) << (8 * i);
    return static_cast<T>(value);
  }
  /// MCAP counts nanoseconds without sign.
  std::int64_t Time();
  std::span<const std::byte> Raw(std::uint64_t size) {
    if (size > bytes_.size()) throw RecordError("a record ends early");
    const auto head = bytes_.first(static_cast<std::size_t>(size));
    bytes_ = bytes_.subspan(static_cast<std::size_t>(size));
    return head;
  }
  std::string String();
  LogMetadata Map();
  /// The bytes of a list that begins with its size.
  ByteReader List() { return ByteReader(Raw(Int<std::uint32_t>())); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] std::span<const std::byte> rest() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

inline constexpr std::size_t kRecordHead = 9;  // opcode and length

struct RecordHead {
  std::uint8_t op = 0;
  std::uint64_t length = 0;  // of the body that follows
};
[[nodiscard]] RecordHead ParseHead(std::span<const std::byte> bytes);

struct SchemaRecord {
  std::uint16_t id = 0;
  std::string name;
  LogSchema schema;
  bool operator==(const SchemaRecord&) const = default;
};
[[nodiscard]] SchemaRecord ParseSchema(std::span<const std::byte> body);

struct ChannelRecord {
  std::uint16_t id = 0, schema_id = 0;  // schema 0: none
  std::string topic, message_encoding;
  LogMetadata metadata;
  bool operator==(const ChannelRecord&) const = default;
};
[[nodiscard]] ChannelRecord ParseChannel(std::span<const std::byte> body);

struct MessageRecord {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::int64_t log_time_ns = 0, publish_time_ns = 0;
  std::span<const std::byte> data;
};
[[nodiscard]] MessageRecord ParseMessage(std::span<const std::byte> body);

struct ChunkRecord {
  LogSpan span;
  std::uint64_t unpacked_size = 0, packed_size = 0;
  std::uint32_t crc = 0;  // of the unpacked records; 0: none
  std::string compression;
  std::span<const std::byte> packed;  // shorter than packed_size where the file is cut
};
[[nodiscard]] ChunkRecord ParseChunk(std::span<const std::byte> body);

/// Messages of one channel within one chunk.
struct ChannelExtent {
  std::uint16_t channel_id = 0;
  std::uint64_t count = 0;
  LogSpan span;
};
/// Without a span where it lists no message.
[[nodiscard]] ChannelExtent ParseMessageIndex(std::span<const std::byte> body);

struct ChunkIndexRecord {
  LogSpan span;
  std::uint64_t offset = 0, length = 0, index_length = 0, packed_size = 0, unpacked_size = 0;
};
[[nodiscard]] ChunkIndexRecord ParseChunkIndex(std::span<const std::byte> body);

struct StatisticsRecord {
  std::uint64_t messages = 0;
  std::uint32_t channels = 0, attachments = 0, metadata = 0, chunks = 0;
};
[[nodiscard]] StatisticsRecord ParseStatistics(std::span<const std::byte> body);

/// Where an attachment or a metadata record is, of an index.
struct RecordPlace {
  std::uint64_t offset = 0;
  std::string name;
};
[[nodiscard]] RecordPlace ParseAttachmentIndex(std::span<const std::byte> body);
[[nodiscard]] RecordPlace ParseMetadataIndex(std::span<const std::byte> body);

/// Name and content. Errors: RecordError also for a wrong checksum.
[[nodiscard]] std::pair<std::string, LogMetadata> ParseMetadata(std::span<const std::byte> body);
[[nodiscard]] LogAttachment ParseAttachment(std::span<const std::byte> body);
/// Needs its first bytes alone. @returns nothing where they are no attachment's.
[[nodiscard]] std::optional<std::string> NameOfAttachment(std::span<const std::byte> body);

}  // namespace scoria::logs::mcap_format
