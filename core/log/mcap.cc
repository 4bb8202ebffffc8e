// SPDX-License-Identifier: BSD-3-Clause
#include "core/log/mcap.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

namespace scoria::core {
namespace {

constexpr std::array<unsigned char, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', 0x30, '\r', '\n'};
constexpr int kZstdLevel = 1;  // logs of noisy floats: higher levels cost time and gain nothing

/// What rosbag2 wants to know of a channel: reliable, keep the last message.
const McapMetadata kChannelMetadata = {
    {"offered_qos_profiles", "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 2\n"}};

enum Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

std::uint32_t Crc(std::span<const std::byte> bytes, std::uint32_t start = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(start, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

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
  Put& Map(const McapMetadata& map) {
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

/// Takes little-endian values off the front; throws at the end of the data.
class Take {
 public:
  explicit Take(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T Int() {
    const auto raw = Raw(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      value |= static_cast<std::uint64_t>(raw[i]) << (8 * i);
    }
    return static_cast<T>(value);
  }
  std::span<const std::byte> Raw(std::uint64_t size) {
    if (size > bytes_.size()) throw std::runtime_error("record ends early");
    const auto head = bytes_.first(static_cast<std::size_t>(size));
    bytes_ = bytes_.subspan(static_cast<std::size_t>(size));
    return head;
  }
  std::string String() {
    const auto raw = Raw(Int<std::uint32_t>());
    return {reinterpret_cast<const char*>(raw.data()), raw.size()};
  }
  McapMetadata Map() {
    Take body(Raw(Int<std::uint32_t>()));
    McapMetadata map;
    while (!body.empty()) {
      const std::string key = body.String();
      map[key] = body.String();
    }
    return map;
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

Bytes Decompress(const std::string& compression, std::span<const std::byte> packed,
                 std::uint64_t size) {
  constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 32;
  if (size > kLargestChunk) throw std::runtime_error("chunk claims more than 4 GiB");
  if (compression.empty()) {
    if (size != packed.size()) throw std::runtime_error("plain chunk has a wrong size");
    return {packed.begin(), packed.end()};
  }
  Bytes out(static_cast<std::size_t>(size));
  if (compression == "zstd") {
    const std::size_t n = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(n) != 0 || n != out.size())
      throw std::runtime_error("chunk does not decompress");
  } else if (compression == "lz4") {
    LZ4F_dctx* context = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) {
      throw std::runtime_error("no memory for lz4");
    }
    std::size_t done = 0, used = 0, hint = 1;
    while (hint != 0 && used < packed.size() && LZ4F_isError(hint) == 0) {
      std::size_t to = out.size() - done, from = packed.size() - used;
      hint = LZ4F_decompress(context, out.data() + done, &to, packed.data() + used, &from, nullptr);
      done += to;
      used += from;
      if (to == 0 && from == 0) break;
    }
    LZ4F_freeDecompressionContext(context);
    if (hint != 0 || done != out.size()) throw std::runtime_error("chunk does not decompress");
  } else {
    throw std::runtime_error("unknown compression " + compression);
  }
  return out;
}

/// Reads (opcode, body) records off a file and says where it stands.
class RecordStream {
 public:
  explicit RecordStream(const std::filesystem::path& path) : in_(path, std::ios::binary) {
    if (!in_) throw std::runtime_error(fmt::format("{}: cannot read the file", path.string()));
    std::array<unsigned char, 8> magic{};
    in_.read(reinterpret_cast<char*>(magic.data()), magic.size());
    if (in_.gcount() != 8 || magic != kMagic) {
      throw std::runtime_error(fmt::format("{}: not an MCAP file", path.string()));
    }
    size_ = std::filesystem::file_size(path);
    position_ = kMagic.size();
  }

  /// @returns false at the end of the data or where the file is cut.
  bool Next() {
    start_ = position_;
    std::array<std::byte, 9> head;
    in_.read(reinterpret_cast<char*>(head.data()), head.size());
    if (in_.gcount() != 9) return false;
    Take take(head);
    op_ = take.Int<std::uint8_t>();
    length_ = take.Int<std::uint64_t>();
    position_ += 9;
    return length_ <= size_ - position_;
  }
  [[nodiscard]] std::uint8_t op() const { return op_; }
  [[nodiscard]] std::uint64_t start() const { return start_; }
  std::span<const std::byte> Body() {
    body_.resize(static_cast<std::size_t>(length_));
    in_.read(reinterpret_cast<char*>(body_.data()), static_cast<std::streamsize>(length_));
    position_ += length_;
    return body_;
  }
  void Skip() {
    in_.seekg(static_cast<std::streamoff>(length_), std::ios::cur);
    position_ += length_;
  }

 private:
  std::ifstream in_;
  std::uint64_t size_ = 0, position_ = 0, start_ = 0, length_ = 0;
  std::uint8_t op_ = 0;
  Bytes body_;
};

/// Schemas and channels seen so far, and how to hand on their messages.
class MessageDispatcher {
 public:
  explicit MessageDispatcher(const McapReader::OnMessage& on_message) : on_message_(on_message) {}

  /// @returns false when the receiver has seen enough.
  bool Handle(std::uint8_t op, std::span<const std::byte> body) {
    Take take(body);
    if (op == kSchema) {
      const auto id = take.Int<std::uint16_t>();
      Schema& schema = schemas_[id];
      schema.name = take.String();
      take.String();  // encoding
      const auto text = take.Raw(take.Int<std::uint32_t>());
      schema.text.assign(reinterpret_cast<const char*>(text.data()), text.size());
    } else if (op == kChannel) {
      const auto id = take.Int<std::uint16_t>();
      const Schema& schema = schemas_[take.Int<std::uint16_t>()];
      const std::string topic = take.String();
      channels_[id] = {topic, schema.name, schema.text, take.String()};
    } else if (op == kMessage) {
      const auto channel = channels_.find(take.Int<std::uint16_t>());
      if (channel == channels_.end()) throw std::runtime_error("message of an unknown channel");
      take.Int<std::uint32_t>();  // sequence
      const auto time = take.Int<std::uint64_t>();
      take.Int<std::uint64_t>();  // publish time
      const std::size_t head = 2 + 4 + 8 + 8;
      return on_message_({channel->second, static_cast<std::int64_t>(time), body.subspan(head)});
    }
    return true;
  }

  bool HandleChunk(std::span<const std::byte> body) {
    Take take(body);
    take.Int<std::uint64_t>();
    take.Int<std::uint64_t>();
    const auto size = take.Int<std::uint64_t>();
    const auto crc = take.Int<std::uint32_t>();
    const std::string compression = take.String();
    const Bytes records = Decompress(compression, take.Raw(take.Int<std::uint64_t>()), size);
    if (crc != 0 && Crc(records) != crc) throw std::runtime_error("chunk has a wrong checksum");
    Take inner(records);
    while (!inner.empty()) {
      const auto op = inner.Int<std::uint8_t>();
      if (!Handle(op, inner.Raw(inner.Int<std::uint64_t>()))) return false;
    }
    return true;
  }

 private:
  struct Schema {
    std::string name, text;
  };
  const McapReader::OnMessage& on_message_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, McapReader::ChannelInfo> channels_;
};

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, std::size_t chunk_bytes)
    : out_(path, std::ios::binary), path_(path.string()), chunk_bytes_(chunk_bytes) {
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot open for writing", path_));
  Bytes bytes;
  Put(bytes).Raw(std::as_bytes(std::span(kMagic)));
  Bytes header;
  Put(header).String("ros2").String("scoria");
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
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot write", path_));
  offset_ += bytes.size();
}

std::uint16_t McapWriter::AddChannel(const std::string& topic, const std::string& type_name,
                                     const std::string& schema_text) {
  auto schema = std::find_if(schemas_.begin(), schemas_.end(),
                             [&](const Schema& s) { return s.name == type_name; });
  if (schema == schemas_.end()) {
    schemas_.push_back({type_name, schema_text, false});
    schema = schemas_.end() - 1;
  }
  channels_.push_back(
      {static_cast<std::uint16_t>(schema - schemas_.begin() + 1), topic, 0, false, 0});
  return static_cast<std::uint16_t>(channels_.size() - 1);
}

void McapWriter::Write(std::uint16_t number, std::int64_t time_ns,
                       std::span<const std::byte> message) {
  Channel& channel = channels_.at(number);
  const auto time = static_cast<std::uint64_t>(time_ns);
  if (!channel.announced) {
    Schema& schema = schemas_[channel.schema - 1u];
    if (!schema.announced) {
      Bytes body;
      Put(body).Int(channel.schema).String(schema.name).String("ros2msg").String(schema.text);
      AppendRecord(chunk_, kSchema, body);
      schema.announced = true;
    }
    Bytes body;
    Put(body)
        .Int(number)
        .Int(channel.schema)
        .String(channel.topic)
        .String("cdr")
        .Map(kChannelMetadata);
    AppendRecord(chunk_, kChannel, body);
    channel.announced = true;
  }
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
      .Int(channel.sequence++)
      .Int(time)
      .Int(time)
      .Raw(message);
  ++channel.count;
  ++total_;
  if (chunk_.size() >= chunk_bytes_) FlushChunk();
}

void McapWriter::FlushChunk() {
  if (chunk_.empty()) return;
  Bytes packed(ZSTD_compressBound(chunk_.size()));
  const std::size_t n =
      ZSTD_compress(packed.data(), packed.size(), chunk_.data(), chunk_.size(), kZstdLevel);
  if (ZSTD_isError(n) != 0) throw std::runtime_error(fmt::format("{}: cannot compress", path_));
  packed.resize(n);

  Bytes body, bytes;
  Put(body)
      .Int(chunk_first_ns_)
      .Int(chunk_last_ns_)
      .Int(static_cast<std::uint64_t>(chunk_.size()))
      .Int(Crc(chunk_))
      .String("zstd")
      .Int(static_cast<std::uint64_t>(packed.size()))
      .Raw(packed);
  AppendRecord(bytes, kChunk, body);
  ChunkIndex index{chunk_first_ns_, chunk_last_ns_, offset_, bytes.size(), 0,
                   packed.size(),   chunk_.size(),  {}};
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

void McapWriter::AddMetadata(const std::string& name, const McapMetadata& metadata) {
  FlushChunk();
  Bytes body, bytes;
  Put(body).String(name).Map(metadata);
  AppendRecord(bytes, kMetadata, body);
  metadata_indexes_.push_back({offset_, bytes.size(), name});
  Emit(bytes);
}

void McapWriter::WriteSummary() {
  const std::uint64_t summary_start = offset_;
  const auto is_announced = [](const auto& item) { return item.announced; };
  Bytes summary, offsets;
  const auto group = [&](Op op, const auto& write_records) {
    const std::size_t before = summary.size();
    write_records();
    if (summary.size() == before) return;
    Bytes body;
    Put(body)
        .Int(static_cast<std::uint8_t>(op))
        .Int(summary_start + before)
        .Int(static_cast<std::uint64_t>(summary.size() - before));
    AppendRecord(offsets, kSummaryOffset, body);
  };
  group(kSchema, [&] {
    for (std::size_t i = 0; i < schemas_.size(); ++i) {
      if (!schemas_[i].announced) continue;
      Bytes body;
      Put(body)
          .Int(static_cast<std::uint16_t>(i + 1))
          .String(schemas_[i].name)
          .String("ros2msg")
          .String(schemas_[i].text);
      AppendRecord(summary, kSchema, body);
    }
  });
  group(kChannel, [&] {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (!channels_[i].announced) continue;
      Bytes body;
      Put(body)
          .Int(static_cast<std::uint16_t>(i))
          .Int(channels_[i].schema)
          .String(channels_[i].topic)
          .String("cdr")
          .Map(kChannelMetadata);
      AppendRecord(summary, kChannel, body);
    }
  });
  group(kStatistics, [&] {
    Bytes counts, body;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (!channels_[i].announced) continue;
      Put(counts).Int(static_cast<std::uint16_t>(i)).Int(channels_[i].count);
    }
    Put(body)
        .Int(total_)
        .Int(static_cast<std::uint16_t>(
            std::count_if(schemas_.begin(), schemas_.end(), is_announced)))
        .Int(static_cast<std::uint32_t>(
            std::count_if(channels_.begin(), channels_.end(), is_announced)))
        .Int(std::uint32_t{0})
        .Int(static_cast<std::uint32_t>(metadata_indexes_.size()))
        .Int(static_cast<std::uint32_t>(chunk_indexes_.size()))
        .Int(first_ns_)
        .Int(last_ns_)
        .Int(static_cast<std::uint32_t>(counts.size()))
        .Raw(counts);
    AppendRecord(summary, kStatistics, body);
  });
  group(kChunkIndex, [&] {
    for (const ChunkIndex& c : chunk_indexes_) {
      Bytes map, body;
      for (const auto& [channel, offset] : c.index_offsets) Put(map).Int(channel).Int(offset);
      Put(body).Int(c.first_ns).Int(c.last_ns).Int(c.offset).Int(c.length);
      Put(body)
          .Int(static_cast<std::uint32_t>(map.size()))
          .Raw(map)
          .Int(c.index_length)
          .String("zstd");
      Put(body).Int(c.compressed).Int(c.uncompressed);
      AppendRecord(summary, kChunkIndex, body);
    }
  });
  group(kMetadataIndex, [&] {
    for (const MetadataIndex& m : metadata_indexes_) {
      Bytes body;
      Put(body).Int(m.offset).Int(m.length).String(m.name);
      AppendRecord(summary, kMetadataIndex, body);
    }
  });

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
  Put(body).Int(std::uint32_t{0});  // 0: the data section has no checksum of its own
  AppendRecord(bytes, kDataEnd, body);
  Emit(bytes);
  WriteSummary();
  out_.close();
}

McapReader::McapReader(std::filesystem::path path) : path_(std::move(path)) {
  RecordStream check(path_);  // throws if unreadable
}

std::string McapReader::ForEachMessage(const OnMessage& on_message) {
  RecordStream stream(path_);
  MessageDispatcher dispatcher(on_message);
  try {
    while (stream.Next()) {
      if (stream.op() == kDataEnd || stream.op() == kFooter) return "";
      const bool wanted = stream.op() == kChunk || stream.op() == kSchema ||
                          stream.op() == kChannel || stream.op() == kMessage;
      if (!wanted) {
        stream.Skip();
        continue;
      }
      const auto body = stream.Body();
      const bool more = stream.op() == kChunk ? dispatcher.HandleChunk(body)
                                              : dispatcher.Handle(stream.op(), body);
      if (!more) return "";
    }
  } catch (
      const std::exception& e) {  // also what the receiver throws at a message it cannot decode
    return fmt::format("{}: at byte {}: {}", path_.string(), stream.start(), e.what());
  }
  return fmt::format("{}: cut off at byte {}; everything before it was read", path_.string(),
                     stream.start());
}

std::map<std::string, McapMetadata> McapReader::ReadMetadata() const {
  std::map<std::string, McapMetadata> all;
  RecordStream stream(path_);
  while (stream.Next()) {
    if (stream.op() == kDataEnd || stream.op() == kFooter) break;
    if (stream.op() != kMetadata) {
      stream.Skip();
      continue;
    }
    Take take(stream.Body());
    const std::string name = take.String();
    all[name] = take.Map();
  }
  return all;
}

}  // namespace scoria::core
