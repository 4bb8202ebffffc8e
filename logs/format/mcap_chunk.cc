// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_chunk.h"

#include <memory>

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include "core/text.h"

namespace scoria::logs::mcap_format {
namespace {

constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 28;

/// How much larger than its bytes a chunk can be: a zstd block of 4 bytes stands for 128 KiB at
/// most, an lz4 byte for 255. Source: [Collet2021] section 3.1.1.2.
std::uint64_t LargestRatio(const std::string& compression) {
  constexpr std::uint64_t kZstd = (128 << 10) / 4, kLz4 = 255;
  return compression == "zstd" ? kZstd : kLz4;
}

/// How far unpacking came.
struct Unpacked {
  std::size_t size = 0;    // of what came out
  bool to_its_end = true;  // all was taken in, and nothing is left to come
};

Unpacked Unzstd(std::span<const std::byte> packed, std::span<std::byte> out) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     &ZSTD_freeDCtx);
  ZSTD_inBuffer from{packed.data(), packed.size(), 0};
  ZSTD_outBuffer to{out.data(), out.size(), 0};
  std::size_t hint = 0;
  while (from.pos < from.size) {
    const std::size_t from_before = from.pos, to_before = to.pos;
    hint = ZSTD_decompressStream(context.get(), &to, &from);
    if (ZSTD_isError(hint) != 0 || (from.pos == from_before && to.pos == to_before)) break;
  }
  return {to.pos, hint == 0 && from.pos == from.size};
}

Unpacked Unlz4(std::span<const std::byte> packed, std::span<std::byte> out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return {0, false};
  std::size_t used = 0, done = 0, hint = 0;
  while (used < packed.size()) {
    std::size_t from = packed.size() - used, to = out.size() - done;
    hint = LZ4F_decompress(context, out.data() + done, &to, packed.data() + used, &from, nullptr);
    if (LZ4F_isError(hint) != 0 || (from == 0 && to == 0)) break;
    used += from;
    done += to;
  }
  LZ4F_freeDecompressionContext(context);
  return {done, hint == 0 && used == packed.size()};
}

std::string ClaimProblem(const ChunkRecord& chunk) {
  const bool is_plain = chunk.compression.empty();
  if (!is_plain && chunk.compression != "zstd" && chunk.compression != "lz4")
    return fmt::format("unknown compression \"{}\"", core::Shown(chunk.compression));
  if (chunk.unpacked_size > kLargestChunk) return "chunk claims more than 256 MiB";
  const bool fits =
      is_plain ? chunk.unpacked_size == chunk.packed_size
               : chunk.unpacked_size / LargestRatio(chunk.compression) <= chunk.packed.size();
  return fits ? "" : "chunk has a wrong size";
}

}  // namespace

UnpackedChunk UnpackChunk(const ChunkRecord& chunk) {
  UnpackedChunk out;
  out.problem = ClaimProblem(chunk);
  if (!out.problem.empty()) return out;
  Unpacked unpacked{chunk.packed.size(), true};
  if (chunk.compression.empty()) {
    out.records = chunk.packed;
  } else {
    out.storage.resize(static_cast<std::size_t>(chunk.unpacked_size));
    unpacked = chunk.compression == "zstd" ? Unzstd(chunk.packed, out.storage)
                                           : Unlz4(chunk.packed, out.storage);
    out.records = std::span<const std::byte>(out.storage).first(unpacked.size);
  }
  out.is_cut = chunk.packed.size() < chunk.packed_size;
  if (out.is_cut) return out;
  if (!unpacked.to_its_end) {
    out.problem = "chunk does not decompress";
  } else if (unpacked.size != chunk.unpacked_size) {
    out.problem = "chunk has a wrong size";
  } else if (chunk.crc != 0 && Crc(out.records) != chunk.crc) {
    out.problem = "chunk has a wrong checksum";
  }
  if (!out.problem.empty()) out.records = {};
  return out;
}

}  // namespace scoria::logs::mcap_format
