// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>

#include <lz4frame.h>
#include <zstd.h>

#include "core/file_kind.h"
#include "logs/format/mcap.h"
#include "logs/format/mcap_format.h"

namespace scoria::logs {
namespace {

using namespace mcap_format;  // this file reads the format

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
  [[nodiscard]] std::span<const std::byte> rest() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

Bytes Decompress(const std::string& compression, std::span<const std::byte> packed,
                 std::uint64_t size) {
  constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 28;
  if (size > kLargestChunk) throw std::runtime_error("chunk claims more than 256 MiB");
  if (compression.empty()) {
    if (size != packed.size()) throw std::runtime_error("plain chunk has a wrong size");
    return {packed.begin(), packed.end()};
  }
  if (compression == "zstd") {
    const std::uint64_t content = ZSTD_getFrameContentSize(packed.data(), packed.size());
    if (content != size && content != ZSTD_CONTENTSIZE_UNKNOWN)
      throw std::runtime_error("chunk has a wrong size");
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

/// What a file is that does not begin as an MCAP file does.
std::string WhatElse(const std::filesystem::path& path) {
  constexpr std::size_t kHead = 4096;
  std::string head(kHead, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const core::FileKind kind = core::KindOfContent(head);
  return kind.name.empty() ? "not an MCAP file" : core::NotOfKind(kind, "an MCAP file");
}

/// Reads (opcode, body) records off a file and says where it stands.
class RecordStream {
 public:
  explicit RecordStream(const std::filesystem::path& path) : in_(path, std::ios::binary) {
    if (!in_) throw std::runtime_error(fmt::format("{}: cannot read the file", path.string()));
    std::array<unsigned char, 8> magic{};
    in_.read(reinterpret_cast<char*>(magic.data()), magic.size());
    if (in_.gcount() != 8 || magic != kMagic)
      throw std::runtime_error(fmt::format("{}: {}", path.string(), WhatElse(path)));
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

namespace {

/// Calls visit(body) for each record of one kind, until it returns false or the data end.
template <class Visit>
void ForEachRecord(const std::filesystem::path& path, Op op, Visit visit) {
  RecordStream stream(path);
  while (stream.Next()) {
    if (stream.op() == kDataEnd || stream.op() == kFooter) return;
    if (stream.op() != op) {
      stream.Skip();
      continue;
    }
    try {
      if (!visit(Take(stream.Body()))) return;
    } catch (const std::exception& e) {
      throw std::runtime_error(
          fmt::format("{}: at byte {}: {}", path.string(), stream.start(), e.what()));
    }
  }
}

}  // namespace

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
  ForEachRecord(path_, kMetadata, [&](Take take) {
    const std::string name = take.String();
    all[name] = take.Map();
    return true;
  });
  return all;
}

std::optional<McapAttachment> McapReader::ReadAttachment(const std::string& name) const {
  std::optional<McapAttachment> found;
  ForEachRecord(path_, kAttachment, [&](Take take) {
    const std::span<const std::byte> body = take.rest();
    take.Int<std::uint64_t>();  // log time
    take.Int<std::uint64_t>();  // creation time
    McapAttachment attachment;
    attachment.name = take.String();
    if (attachment.name != name) return true;
    attachment.media_type = take.String();
    const auto data = take.Raw(take.Int<std::uint64_t>());
    const auto checked = body.first(body.size() - take.rest().size());
    const auto crc = take.Int<std::uint32_t>();
    if (crc != 0 && crc != Crc(checked)) throw std::runtime_error("wrong checksum");
    attachment.data.assign(data.begin(), data.end());
    found = std::move(attachment);
    return false;
  });
  return found;
}

bool McapReader::IsWhole() const {
  RecordStream stream(path_);
  while (stream.Next()) {
    if (stream.op() == kDataEnd || stream.op() == kFooter) return true;
    stream.Skip();
  }
  return false;
}

}  // namespace scoria::logs
