// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/log_rows.h"

#include <memory>

#include "logs/format/open_log.h"
#include "logs/read_rows.h"

namespace scoria::app {

LogRows::LogRows(std::vector<std::filesystem::path> files, logs::RowsOptions options)
    : files_(std::move(files)), options_(std::move(options)) {
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(files_);
  if (options_.mapping || !logs::HasOwnRows(log->contents()))
    mapping_.emplace(logs::MappingFor(log->contents(), options_.mapping));
}

logs::RowsReport LogRows::ForEach(const std::function<void(const logs::Row&)>& on_row) const {
  if (!mapping_) return {std::nullopt, logs::ForEachRow(files_.front(), on_row)};
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(files_);
  logs::MappingReport report =
      logs::ForEachMappedRow(*log, *mapping_, logs::TypeResolver(options_.msg_paths), on_row);
  std::string problem = logs::ProblemText(report.problems);
  return {std::move(report), std::move(problem)};
}

}  // namespace scoria::app
