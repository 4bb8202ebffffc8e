// SPDX-License-Identifier: BSD-3-Clause
#include "app/export/export_signals.h"

#include <stdexcept>

#include <fmt/format.h>

#include "core/draft_file.h"
#include "core/files.h"
#include "logs/csv_line.h"
#include "logs/messages/read_messages.h"
#include "logs/read_rows.h"
#include "logs/row_table.h"

namespace scoria::app {
namespace {

/// The groups whose topics a log has.
logs::RowGroups GroupsOf(const logs::LogContents& contents) {
  logs::RowGroups groups;
  for (const logs::LogChannel& channel : contents.channels) {
    for (const auto& [group, name] : EnumNames(logs::RowGroup{}))
      groups[static_cast<std::size_t>(group)] =
          groups[static_cast<std::size_t>(group)] || channel.topic == logs::TopicOf(group);
  }
  return groups;
}

}  // namespace

ExportResult ExportSignals(const ExportOptions& options) {
  const ExportSource source = OpenExport(options);
  const logs::RowGroups groups = GroupsOf(source.log->contents());
  if (groups.none())
    throw std::runtime_error(fmt::format(
        "{}: holds no canonical signals; logs that scoria writes with log.topics: all do",
        options.log.string()));
  if (const std::string other = logs::DescribeOtherLayout(*source.log); !other.empty())
    throw std::runtime_error(fmt::format("{}: {}", options.log.string(), other));
  CheckTarget(options.out, options);
  if (const auto folder = options.out.parent_path(); !folder.empty()) core::CreateFolders(folder);
  logs::RowTable table(groups);
  core::DraftFile file(options.out);
  file.Append(logs::CsvLine(table.columns()));
  std::uint64_t rows = 0;
  logs::RowJoiner joiner([&](const logs::Row& row) {
    file.Append(logs::CsvLine(table.Read(row)));
    ++rows;
  });
  ExportResult result;
  const auto take = [&](const logs::LogMessage& m) {
    (void)joiner.Add(m);
    return !IsInterrupted(options);
  };
  for (const logs::LogProblem& problem : logs::ReadMessages(*source.log, source.filter, take))
    result.remarks.push_back(fmt::format("{}: {}", problem.file.string(), problem.what));
  joiner.Finish();
  if (const std::string problem = logs::DescribeRowProblems(*source.log, joiner); !problem.empty())
    result.remarks.push_back(fmt::format("{}: {}", options.log.string(), problem));
  result.was_interrupted = IsInterrupted(options);
  if (result.was_interrupted) return result;
  file.Publish();
  result.files.push_back({options.out, rows});
  return result;
}

}  // namespace scoria::app
