// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "logs/format/mcap_records.h"

namespace scoria::logs::mcap_format {

/// The records of a chunk, as far as they could be had.
struct UnpackedChunk {
  Bytes storage;                       // empty where the chunk was not packed
  std::span<const std::byte> records;  // in `storage` or in the chunk
  bool is_cut = false;                 // the records are the first part of all
  std::string problem;                 // empty: nothing else is wrong
};

/// Unpacks a chunk (zstd, lz4 or none), which is borrowed by the result. Of one whose packed bytes
/// are not all there it takes what is; one that is damaged gives no records.
[[nodiscard]] UnpackedChunk UnpackChunk(const ChunkRecord& chunk);

}  // namespace scoria::logs::mcap_format
