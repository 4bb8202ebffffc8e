// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/any_rows.h"

#include <algorithm>

#include "logs/format/open_log.h"
#include "logs/mapping/choose_mapping.h"
#include "logs/read_rows.h"

namespace scoria::logs {

bool HasOwnRows(const LogContents& contents) {
  return std::any_of(contents.channels.begin(), contents.channels.end(),
                     [](const LogChannel& c) { return c.topic.starts_with(kRowTopics); });
}

Mapping MappingFor(const LogContents& contents, const std::optional<std::string>& asked_for) {
  return asked_for ? FindMapping(*asked_for) : ChooseMapping(contents, ShippedMappings());
}

RowsReport ForEachRow(const std::vector<std::filesystem::path>& log, const RowsOptions& options,
                      const std::function<void(const Row&)>& on_row) {
  const std::unique_ptr<LogSource> source = OpenLog(log);
  if (!options.mapping && HasOwnRows(source->contents()))
    return {std::nullopt, ForEachRow(log.front(), on_row)};
  const Mapping mapping = MappingFor(source->contents(), options.mapping);
  MappingReport report =
      ForEachMappedRow(*source, mapping, TypeResolver(options.msg_paths), on_row);
  std::string problem = ProblemText(report.problems);
  return {std::move(report), std::move(problem)};
}

}  // namespace scoria::logs
