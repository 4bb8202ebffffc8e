// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "logs/format/log_file.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// Whether a file is an MCAP file, by its first or, where those are damaged, its last eight bytes.
[[nodiscard]] bool IsMcap(std::span<const std::byte> first, std::span<const std::byte> last);

/// Opens an MCAP file, whatever wrote it: chunked (zstd, lz4 or plain) or not, with or without
/// summary and indexes, also one that ends in the middle. With a filter it reads only the chunks
/// that hold what is wanted. Source: [MCAP] specification, version 0.
/// Errors: core::FileError.
[[nodiscard]] std::unique_ptr<LogSource> OpenMcap(const LogFile& file);

}  // namespace scoria::logs
