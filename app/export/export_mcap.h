// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/export/export_log.h"

namespace scoria::app {

/// Copies a log of any format to the MCAP file options.out: messages bit for bit in the order in
/// which they are stored, their times and sequence numbers, channels with their metadata, metadata
/// records and attachments. A channel without definition gets the one that all its messages fit.
/// Errors: as OpenExport and CheckTarget; core::FileError.
[[nodiscard]] ExportResult ExportMcap(const ExportOptions& options);

}  // namespace scoria::app
