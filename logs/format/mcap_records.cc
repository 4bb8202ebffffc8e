// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_records.h"

#include <algorithm>

namespace scoria::logs::mcap_format {
namespace {

std::string ToText(std::span<const std::byte> raw) {
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

}  // namespace

std::int64_t ByteReader::Time() {
  constexpr std::uint64_t kLast = std::numeric_limits<std::int64_t>::max();
  return static_cast<std::int64_t>(std::min(Int<std::uint64_t>(), kLast));
}

std::string ByteReader::String() { return ToText(Raw(Int<std::uint32_t>())); }

LogMetadata ByteReader::Map() {
  LogMetadata map;
  for (ByteReader entries = List(); !entries.empty();) {
    std::string key = entries.String();
    map[std::move(key)] = entries.String();
  }
  return map;
}

RecordHead ParseHead(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  RecordHead head;
  head.op = in.Int<std::uint8_t>();
  head.length = in.Int<std::uint64_t>();
  return head;
}

SchemaRecord ParseSchema(std::span<const std::byte> body) {
  ByteReader in(body);
  SchemaRecord r;
  r.id = in.Int<std::uint16_t>();
  r.name = in.String();
  r.schema.encoding = in.String();
  r.schema.text = in.String();
  return r;
}

ChannelRecord ParseChannel(std::span<const std::byte> body) {
  ByteReader in(body);
  ChannelRecord r;
  r.id = in.Int<std::uint16_t>();
  r.schema_id = in.Int<std::uint16_t>();
  r.topic = in.String();
  r.message_encoding = in.String();
  r.metadata = in.Map();
  return r;
}

MessageRecord ParseMessage(std::span<const std::byte> body) {
  ByteReader in(body);
  MessageRecord r;
  r.channel_id = in.Int<std::uint16_t>();
  r.sequence = in.Int<std::uint32_t>();
  r.log_time_ns = in.Time();
  r.publish_time_ns = in.Time();
  r.data = in.rest();
  return r;
}

ChunkRecord ParseChunk(std::span<const std::byte> body) {
  ByteReader in(body);
  ChunkRecord r;
  r.span.first_ns = in.Time();
  r.span.last_ns = in.Time();
  r.unpacked_size = in.Int<std::uint64_t>();
  r.crc = in.Int<std::uint32_t>();
  r.compression = in.String();
  r.packed_size = in.Int<std::uint64_t>();
  r.packed = in.Raw(std::min<std::uint64_t>(r.packed_size, in.rest().size()));
  return r;
}

ChannelExtent ParseMessageIndex(std::span<const std::byte> body) {
  ByteReader in(body);
  ChannelExtent r;
  r.channel_id = in.Int<std::uint16_t>();
  for (ByteReader entries = in.List(); !entries.empty(); ++r.count) {
    const std::int64_t time_ns = entries.Time();
    entries.Int<std::uint64_t>();  // offset within the chunk
    if (r.count == 0) r.span = {time_ns, time_ns};
    r.span = {std::min(r.span.first_ns, time_ns), std::max(r.span.last_ns, time_ns)};
  }
  return r;
}

ChunkIndexRecord ParseChunkIndex(std::span<const std::byte> body) {
  ByteReader in(body);
  ChunkIndexRecord r;
  r.span.first_ns = in.Time();
  r.span.last_ns = in.Time();
  r.offset = in.Int<std::uint64_t>();
  r.length = in.Int<std::uint64_t>();
  in.List();  // offset of each channel's message index
  r.index_length = in.Int<std::uint64_t>();
  in.String();  // compression
  r.packed_size = in.Int<std::uint64_t>();
  r.unpacked_size = in.Int<std::uint64_t>();
  return r;
}

StatisticsRecord ParseStatistics(std::span<const std::byte> body) {
  ByteReader in(body);
  StatisticsRecord r;
  r.messages = in.Int<std::uint64_t>();
  in.Int<std::uint16_t>();  // schemas
  r.channels = in.Int<std::uint32_t>();
  r.attachments = in.Int<std::uint32_t>();
  r.metadata = in.Int<std::uint32_t>();
  r.chunks = in.Int<std::uint32_t>();
  return r;
}

RecordPlace ParseAttachmentIndex(std::span<const std::byte> body) {
  ByteReader in(body);
  RecordPlace r;
  r.offset = in.Int<std::uint64_t>();
  in.Int<std::uint64_t>();  // length
  in.Time();                // of the record
  in.Time();                // of its creation
  in.Int<std::uint64_t>();  // size of its data
  r.name = in.String();
  return r;
}

RecordPlace ParseMetadataIndex(std::span<const std::byte> body) {
  ByteReader in(body);
  RecordPlace r;
  r.offset = in.Int<std::uint64_t>();
  in.Int<std::uint64_t>();  // length
  r.name = in.String();
  return r;
}

std::pair<std::string, LogMetadata> ParseMetadata(std::span<const std::byte> body) {
  ByteReader in(body);
  std::string name = in.String();
  return {std::move(name), in.Map()};
}

LogAttachment ParseAttachment(std::span<const std::byte> body) {
  ByteReader in(body);
  in.Time();  // of the record
  in.Time();  // of its creation
  LogAttachment r;
  r.name = in.String();
  r.media_type = in.String();
  const auto data = in.Raw(in.Int<std::uint64_t>());
  const auto checked = body.first(body.size() - in.rest().size());
  const auto crc = in.Int<std::uint32_t>();
  if (crc != 0 && crc != Crc(checked)) throw RecordError("wrong checksum");
  r.data.assign(data.begin(), data.end());
  return r;
}

std::optional<std::string> NameOfAttachment(std::span<const std::byte> body) {
  try {
    ByteReader in(body);
    in.Time();
    in.Time();
    return in.String();
  } catch (const RecordError&) {
    return std::nullopt;
  }
}

}  // namespace scoria::logs::mcap_format
