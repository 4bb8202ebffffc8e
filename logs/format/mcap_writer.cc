// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_writer.h"

#include <algorithm>
#include <cerrno>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include "core/files.h"
#include "logs/format/mcap_format.h"

namespace scoria::logs {
namespace {

using namespace mcap_format;  // this file writes the format

constexpr int kZstdLevel = 1;  // logs of noisy floats: higher levels cost time and gain nothing

/// As MCAP spells it.
std::string NameOf(McapCompression compression) {
  if (compression == McapCompression::kZstd) return "zstd";
  return compression == McapCompression::kLz4 ? "lz4" : "";
}

/// Nothing where the library fails.
std::optional<Bytes> Pack(const Bytes& plain, McapCompression compression) {
  if (compression == McapCompression::kNone) return plain;
  const bool is_zstd = compression == McapCompression::kZstd;
  Bytes packed(is_zstd ? ZSTD_compressBound(plain.size())
                       : LZ4F_compressFrameBound(plain.size(), nullptr));
  const std::size_t n =
      is_zstd
          ? ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), kZstdLevel)
          : LZ4F_compressFrame(packed.data(), packed.size(), plain.data(), plain.size(), nullptr);
  if (is_zstd ? ZSTD_isError(n) != 0 : LZ4F_isError(n) != 0) return std::nullopt;
  packed.resize(n);
  return packed;
}

/// What rosbag2 wants to know of a channel: reliable, keep the last message.
const LogMetadata kChannelMetadata = {
    {"offered_qos_profiles", "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 2\n"}};

/// Appends little-endian values to a byte vector.
class Put {
 public:
  explicit Put(Bytes& out) : out_(out) {}
  template <class T>
  Put& Int(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      out_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i)));
    }
    return *this;
  }
  Put& Raw(std::span<const std::byte> bytes) {
    out_.insert(out_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  Put& String(const std::string& text) {
    Int(static_cast<std::uint32_t>(text.size()));
    return Raw(std::as_bytes(std::span(text)));
  }
  Put& Map(const LogMetadata& map) {
    Bytes body;
    for (const auto& [key, value] : map) Put(body).String(key).String(value);
    Int(static_cast<std::uint32_t>(body.size()));
    return Raw(body);
  }

 private:
  Bytes& out_;
};

void AppendRecord(Bytes& out, Op op, const Bytes& body) {
  Put(out)
      .Int(static_cast<std::uint8_t>(op))
      .Int(static_cast<std::uint64_t>(body.size()))
      .Raw(body);
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, std::size_t chunk_bytes,
                       McapCompression compression, const std::string& profile)
    : out_(path, std::ios::binary),
      path_(path.string()),
      chunk_bytes_(chunk_bytes),
      compression_(compression) {
  if (!out_) throw core::FileError(path_, "cannot write", errno);
  Bytes bytes;
  Put(bytes).Raw(std::as_bytes(std::span(kMagic)));
  Bytes header;
  Put(header).String(profile).String("scoria");
  AppendRecord(bytes, kHeader, header);
  Emit(bytes);
}

McapWriter::~McapWriter() {
  try {
    Close();
  } catch (const std::exception&) {
    // Nothing can be told from a destructor; whoever wants to know calls Close().
  }
}

void McapWriter::Emit(const Bytes& bytes) {
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  out_.flush();
  if (!out_) throw core::FileError(path_, "cannot write", errno);
  offset_ += bytes.size();
}

std::uint16_t McapWriter::AddChannel(const std::string& topic, const std::string& type_name,
                                     const std::string& schema_text) {
  Channel channel;
  channel.topic = topic;
  channel.message_encoding = "cdr";
  channel.metadata = kChannelMetadata;
  return Add(std::move(channel), type_name, LogSchema{"ros2msg", schema_text});
}

std::uint16_t McapWriter::CopyChannel(const LogChannel& from) {
  Channel channel;
  channel.topic = from.topic;
  channel.message_encoding = from.message_encoding;
  channel.metadata = from.metadata;
  channel.is_kept = true;
  return Add(std::move(channel), from.type_name, from.schema);
}

std::uint16_t McapWriter::Add(Channel channel, const std::string& type_name,
                              const std::optional<LogSchema>& schema) {
  constexpr std::size_t kMostChannels = 65535;  // numbers have 16 bits, and schema 0 is none
  if (channels_.size() == kMostChannels)
    throw std::runtime_error(fmt::format("{}: more than {} channels", path_, kMostChannels));
  // A type whose container has no definition keeps its name by an empty schema.
  if (schema || !type_name.empty()) {
    const LogSchema wanted = schema.value_or(LogSchema{});
    auto known = std::find_if(schemas_.begin(), schemas_.end(), [&](const Schema& s) {
      return s.name == type_name && s.schema == wanted;
    });
    if (known == schemas_.end()) {
      schemas_.push_back({type_name, wanted, false});
      known = schemas_.end() - 1;
    }
    channel.schema = static_cast<std::uint16_t>(known - schemas_.begin() + 1);
  }
  channels_.push_back(std::move(channel));
  return static_cast<std::uint16_t>(channels_.size() - 1);
}

void McapWriter::AppendSchema(Bytes& out, std::size_t index) const {
  const Schema& schema = schemas_[index];
  Bytes body;
  Put(body)
      .Int(static_cast<std::uint16_t>(index + 1))
      .String(schema.name)
      .String(schema.schema.encoding)
      .String(schema.schema.text);
  AppendRecord(out, kSchema, body);
}

void McapWriter::AppendChannel(Bytes& out, std::size_t index) const {
  const Channel& channel = channels_[index];
  Bytes body;
  Put(body)
      .Int(static_cast<std::uint16_t>(index))
      .Int(channel.schema)
      .String(channel.topic)
      .String(channel.message_encoding)
      .Map(channel.metadata);
  AppendRecord(out, kChannel, body);
}

/// Schema and channel, where they are not in the file yet.
void McapWriter::Announce(std::uint16_t number, Bytes& out) {
  Channel& channel = channels_[number];
  if (channel.announced) return;
  if (channel.schema != 0) {
    Schema& schema = schemas_[channel.schema - 1u];
    if (!schema.announced) AppendSchema(out, channel.schema - 1u);
    schema.announced = true;
  }
  AppendChannel(out, number);
  channel.announced = true;
}

void McapWriter::Write(std::uint16_t number, std::int64_t time_ns,
                       std::span<const std::byte> message) {
  const auto time = static_cast<std::uint64_t>(time_ns);
  Append(number, {channels_.at(number).sequence++, time, time}, message);
}

void McapWriter::Copy(std::uint16_t number, const LogMessage& message) {
  const std::uint32_t own = channels_.at(number).sequence++;
  Append(number,
         {message.sequence.value_or(own), static_cast<std::uint64_t>(message.log_time_ns),
          static_cast<std::uint64_t>(message.publish_time_ns.value_or(message.log_time_ns))},
         message.data);
}

void McapWriter::Append(std::uint16_t number, const MessageHead& head,
                        std::span<const std::byte> message) {
  Channel& channel = channels_.at(number);
  const std::uint64_t time = head.log_time_ns;
  Announce(number, chunk_);
  if (chunk_messages_.empty()) chunk_first_ns_ = chunk_last_ns_ = time;
  if (total_ == 0) first_ns_ = last_ns_ = time;
  chunk_first_ns_ = std::min(chunk_first_ns_, time);
  chunk_last_ns_ = std::max(chunk_last_ns_, time);
  first_ns_ = std::min(first_ns_, time);
  last_ns_ = std::max(last_ns_, time);
  chunk_messages_[number].emplace_back(time, chunk_.size());
  const std::uint64_t length = 2 + 4 + 8 + 8 + message.size();
  Put(chunk_)
      .Int(static_cast<std::uint8_t>(kMessage))
      .Int(length)
      .Int(number)
      .Int(head.sequence)
      .Int(time)
      .Int(head.publish_time_ns)
      .Raw(message);
  ++channel.count;
  ++total_;
  if (chunk_.size() >= chunk_bytes_) FlushChunk();
}

void McapWriter::FlushChunk() {
  if (chunk_.empty()) return;
  const std::optional<Bytes> packed = Pack(chunk_, compression_);
  if (!packed) throw std::runtime_error(fmt::format("{}: cannot compress", path_));

  Bytes body, bytes;
  Put(body)
      .Int(chunk_first_ns_)
      .Int(chunk_last_ns_)
      .Int(static_cast<std::uint64_t>(chunk_.size()))
      .Int(Crc(chunk_))
      .String(NameOf(compression_))
      .Int(static_cast<std::uint64_t>(packed->size()))
      .Raw(*packed);
  AppendRecord(bytes, kChunk, body);
  ChunkIndex index{chunk_first_ns_, chunk_last_ns_, offset_, bytes.size(), 0,
                   packed->size(),  chunk_.size(),  {}};
  for (const auto& [channel, messages] : chunk_messages_) {
    index.index_offsets[channel] = offset_ + bytes.size();
    Bytes entries, record;
    for (const auto& [time, at] : messages) Put(entries).Int(time).Int(at);
    Put(record).Int(channel).Int(static_cast<std::uint32_t>(entries.size())).Raw(entries);
    AppendRecord(bytes, kMessageIndex, record);
  }
  index.index_length = bytes.size() - index.length;
  chunk_indexes_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_.clear();
  Emit(bytes);
}

void McapWriter::AddMetadata(const std::string& name, const LogMetadata& metadata) {
  FlushChunk();
  Bytes body, bytes;
  Put(body).String(name).Map(metadata);
  AppendRecord(bytes, kMetadata, body);
  metadata_indexes_.push_back({offset_, bytes.size(), name});
  Emit(bytes);
}

void McapWriter::AddAttachment(const LogAttachment& attachment) {
  FlushChunk();
  Bytes body, bytes;
  Put(body).Int(std::uint64_t{0}).Int(std::uint64_t{0});  // log and creation time
  Put(body).String(attachment.name).String(attachment.media_type);
  Put(body).Int(static_cast<std::uint64_t>(attachment.data.size())).Raw(attachment.data);
  Put(body).Int(Crc(body));
  AppendRecord(bytes, kAttachment, body);
  attachment_indexes_.push_back(
      {offset_, bytes.size(), attachment.data.size(), attachment.name, attachment.media_type});
  Emit(bytes);
}

Bytes McapWriter::SchemaRecords() const {
  Bytes out;
  for (std::size_t i = 0; i < schemas_.size(); ++i) {
    if (schemas_[i].announced) AppendSchema(out, i);
  }
  return out;
}

Bytes McapWriter::ChannelRecords() const {
  Bytes out;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].announced) AppendChannel(out, i);
  }
  return out;
}

Bytes McapWriter::StatisticsRecord() const {
  const auto is_announced = [](const auto& item) { return item.announced; };
  Bytes counts, body, out;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (!channels_[i].announced) continue;
    Put(counts).Int(static_cast<std::uint16_t>(i)).Int(channels_[i].count);
  }
  Put(body)
      .Int(total_)
      .Int(
          static_cast<std::uint16_t>(std::count_if(schemas_.begin(), schemas_.end(), is_announced)))
      .Int(static_cast<std::uint32_t>(
          std::count_if(channels_.begin(), channels_.end(), is_announced)))
      .Int(static_cast<std::uint32_t>(attachment_indexes_.size()))
      .Int(static_cast<std::uint32_t>(metadata_indexes_.size()))
      .Int(static_cast<std::uint32_t>(chunk_indexes_.size()))
      .Int(first_ns_)
      .Int(last_ns_)
      .Int(static_cast<std::uint32_t>(counts.size()))
      .Raw(counts);
  AppendRecord(out, kStatistics, body);
  return out;
}

Bytes McapWriter::ChunkIndexRecords() const {
  Bytes out;
  for (const ChunkIndex& c : chunk_indexes_) {
    Bytes map, body;
    for (const auto& [channel, offset] : c.index_offsets) Put(map).Int(channel).Int(offset);
    Put(body).Int(c.first_ns).Int(c.last_ns).Int(c.offset).Int(c.length);
    Put(body)
        .Int(static_cast<std::uint32_t>(map.size()))
        .Raw(map)
        .Int(c.index_length)
        .String(NameOf(compression_));
    Put(body).Int(c.compressed).Int(c.uncompressed);
    AppendRecord(out, kChunkIndex, body);
  }
  return out;
}

Bytes McapWriter::AttachmentIndexRecords() const {
  Bytes out;
  for (const AttachmentIndex& a : attachment_indexes_) {
    Bytes body;
    Put(body).Int(a.offset).Int(a.length).Int(std::uint64_t{0}).Int(std::uint64_t{0});
    Put(body).Int(a.data_size).String(a.name).String(a.media_type);
    AppendRecord(out, kAttachmentIndex, body);
  }
  return out;
}

Bytes McapWriter::MetadataIndexRecords() const {
  Bytes out;
  for (const MetadataIndex& m : metadata_indexes_) {
    Bytes body;
    Put(body).Int(m.offset).Int(m.length).String(m.name);
    AppendRecord(out, kMetadataIndex, body);
  }
  return out;
}

void McapWriter::WriteSummary() {
  const std::uint64_t summary_start = offset_;
  Bytes summary, offsets;
  for (const auto& [op, records] : {std::pair{kSchema, SchemaRecords()},
                                    {kChannel, ChannelRecords()},
                                    {kStatistics, StatisticsRecord()},
                                    {kChunkIndex, ChunkIndexRecords()},
                                    {kAttachmentIndex, AttachmentIndexRecords()},
                                    {kMetadataIndex, MetadataIndexRecords()}}) {
    if (records.empty()) continue;
    Bytes body;
    Put(body)
        .Int(static_cast<std::uint8_t>(op))
        .Int(summary_start + summary.size())
        .Int(static_cast<std::uint64_t>(records.size()));
    AppendRecord(offsets, kSummaryOffset, body);
    Put(summary).Raw(records);
  }
  const std::uint64_t offsets_start = summary_start + summary.size();
  Put(summary).Raw(offsets);
  Put(summary).Int(static_cast<std::uint8_t>(kFooter)).Int(std::uint64_t{8 + 8 + 4});
  Put(summary).Int(summary_start).Int(offsets_start);
  Put(summary).Int(Crc(summary));
  Put(summary).Raw(std::as_bytes(std::span(kMagic)));
  Emit(summary);
}

void McapWriter::Close() {
  if (closed_) return;
  closed_ = true;
  FlushChunk();
  Bytes body, bytes;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].is_kept) Announce(static_cast<std::uint16_t>(i), bytes);
  }
  Put(body).Int(std::uint32_t{0});  // 0: the data section has no checksum of its own
  AppendRecord(bytes, kDataEnd, body);
  Emit(bytes);
  WriteSummary();
  out_.close();
  if (!out_) throw core::FileError(path_, "cannot write", errno);
}

}  // namespace scoria::logs
