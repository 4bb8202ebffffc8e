// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_index.h"

#include <algorithm>

#include <fmt/format.h>

namespace scoria::logs::mcap_format {

std::string Definitions::Conflict(std::uint8_t op, std::span<const std::byte> body) const {
  if (op == kSchema) {
    const SchemaRecord record = ParseSchema(body);
    const auto known = schemas_.find(record.id);
    if (known == schemas_.end() || known->second == record) return "";
    return fmt::format("schema {} is defined twice, as {} and as {}{}; the first is used",
                       record.id, known->second.name, record.name,
                       known->second.name == record.name ? " with another text" : "");
  }
  const ChannelRecord record = ParseChannel(body);
  const auto known = channels_.find(record.id);
  const bool is_same =
      known == channels_.end() ||
      (known->second.topic == record.topic && known->second.schema_id == record.schema_id &&
       known->second.message_encoding == record.message_encoding);
  if (is_same) return "";
  return fmt::format("channel {} is defined twice, as {} and as {}; the first is used", record.id,
                     known->second.topic, record.topic);
}

std::string Definitions::Add(std::uint8_t op, std::span<const std::byte> body) {
  std::string conflict = Conflict(op, body);
  if (op == kSchema) {
    SchemaRecord record = ParseSchema(body);
    schemas_.try_emplace(record.id, std::move(record));
  } else {
    ChannelRecord record = ParseChannel(body);
    channels_.try_emplace(record.id, std::move(record));
  }
  return conflict;
}

std::uint64_t CountOf(const std::vector<ChannelExtent>& channels) {
  std::uint64_t count = 0;
  for (const ChannelExtent& extent : channels) count += extent.count;
  return count;
}

void ExtentCounter::Add(const ChannelExtent& extent) {
  if (extent.count == 0) return;
  const auto [at, is_new] = extents_.try_emplace(extent.channel_id, extent);
  if (is_new) return;
  ChannelExtent& all = at->second;
  all.count += extent.count;
  all.span.first_ns = std::min(all.span.first_ns, extent.span.first_ns);
  all.span.last_ns = std::max(all.span.last_ns, extent.span.last_ns);
}

bool ExtentCounter::IsWithin(const Definitions& definitions) const {
  return std::all_of(extents_.begin(), extents_.end(), [&](const auto& extent) {
    return definitions.channels().contains(extent.first);
  });
}

LogSpan ExtentCounter::span() const {
  LogSpan span = extents_.begin()->second.span;
  for (const auto& [id, extent] : extents_) {
    span.first_ns = std::min(span.first_ns, extent.span.first_ns);
    span.last_ns = std::max(span.last_ns, extent.span.last_ns);
  }
  return span;
}

std::vector<ChannelExtent> ExtentCounter::extents() const {
  std::vector<ChannelExtent> all;
  for (const auto& [id, extent] : extents_) all.push_back(extent);
  return all;
}

LoadedBlock LoadBlock(const RandomAccessFile& file, const Block& block) {
  constexpr std::uint64_t kSpare = 1 << 20;  // a chunk that does not pack well grows a little
  LoadedBlock loaded;
  if (block.length > kLargestRecord + kSpare) {
    loaded.unpacked.problem = "chunk claims more than 256 MiB";
    return loaded;
  }
  loaded.raw = file.Read(block.offset, block.length);
  if (!block.is_chunk) {
    loaded.unpacked.records = loaded.raw;
    return loaded;
  }
  try {
    ByteReader in(loaded.raw);
    if (in.Int<std::uint8_t>() != kChunk) throw RecordError("no chunk is where the index says");
    in.Int<std::uint64_t>();
    const ChunkRecord chunk = ParseChunk(in.rest());
    const bool is_last = block.offset + block.length == file.size();
    if (chunk.packed.size() < chunk.packed_size && !is_last)
      throw RecordError("chunk has a wrong size");
    loaded.unpacked = UnpackChunk(chunk);
  } catch (const RecordError& e) {
    loaded.unpacked.problem = e.what();
  }
  return loaded;
}

Index ReadIndex(const RandomAccessFile& file) {
  std::string problem;
  try {
    if (std::optional<Index> index = ReadSummary(file)) return *std::move(index);
  } catch (const RecordError& e) {
    problem = fmt::format("the summary is damaged ({}); the file was read without it", e.what());
  }
  Index index = ScanRecords(file);
  if (!problem.empty())
    index.problems.push_back({LogProblem::Kind::kOdd, file.path(), std::move(problem)});
  return index;
}

}  // namespace scoria::logs::mcap_format
