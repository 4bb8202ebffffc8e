// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/export/export_log.h"

namespace scoria::app {

/// Writes the canonical signals of a log, its rows, to the CSV file options.out, as logs::RowTable
/// has them, with the groups that the log has.
/// Errors: as OpenExport and CheckTarget; core::FileError; std::runtime_error if the log has no
/// rows, or rows of another layout.
[[nodiscard]] ExportResult ExportSignals(const ExportOptions& options);

}  // namespace scoria::app
