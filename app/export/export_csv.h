// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/export/export_log.h"

namespace scoria::app {

/// Writes a CSV file per topic to the folder options.out: receive time, time in the header where
/// there is one, and every field as logs::FlatTable has it. Where options.out ends in .csv it is
/// the file of the only topic. Reads the log up to three times; memory does not grow with it. What
/// cannot be decoded is left out and named.
/// Errors: as OpenExport and CheckTarget; core::FileError; std::runtime_error if nothing of what is
/// wanted can be written.
[[nodiscard]] ExportResult ExportCsv(const ExportOptions& options);

}  // namespace scoria::app
