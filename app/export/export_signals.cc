// SPDX-License-Identifier: BSD-3-Clause
#include "app/export/export_signals.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "core/draft_file.h"
#include "core/files.h"
#include "logs/csv_line.h"
#include "logs/mapping/any_rows.h"
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

/// The file of signals while it is written.
class SignalFile {
 public:
  SignalFile(const ExportOptions& options, const logs::RowGroups& groups) : table_(groups) {
    CheckTarget(options.out, options);
    if (const auto folder = options.out.parent_path(); !folder.empty()) core::CreateFolders(folder);
    file_.emplace(options.out);
    file_->Append(logs::CsvLine(table_.columns()));
  }

  void Add(const logs::Row& row) {
    file_->Append(logs::CsvLine(table_.Read(row)));
    ++rows_;
  }

  [[nodiscard]] ExportedFile Publish() {
    file_->Publish();
    return {file_->path(), rows_};
  }

 private:
  logs::RowTable table_;
  std::optional<core::DraftFile> file_;
  std::uint64_t rows_ = 0;
};

/// A log's own rows.
ExportResult ExportOwnRows(const ExportOptions& options, const ExportSource& source) {
  if (const std::string other = logs::DescribeOtherLayout(*source.log); !other.empty())
    throw std::runtime_error(fmt::format("{}: {}", options.log.string(), other));
  SignalFile file(options, GroupsOf(source.log->contents()));
  logs::RowJoiner joiner([&](const logs::Row& row) { file.Add(row); });
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
  if (!result.was_interrupted) result.files.push_back(file.Publish());
  return result;
}

/// Ends a pass over rows.
struct Interruption {};

/// The rows that a mapping makes of a log. A first pass finds what they hold.
ExportResult ExportMappedRows(const ExportOptions& options, const ExportSource& source) {
  const logs::Mapping mapping = logs::MappingFor(source.log->contents(), options.mapping);
  const logs::TypeResolver resolver(options.msg_paths);
  std::optional<SignalFile> file;
  std::optional<double> first_s;
  ExportResult result;
  const auto pass = [&](const logs::Row& row) {
    if (IsInterrupted(options)) throw Interruption();
    if (!file) return;
    if (!first_s) first_s = row.time_s;
    const double since_s = row.time_s - *first_s;
    if (options.from_s && since_s < *options.from_s) return;
    if (!options.to_s || since_s <= *options.to_s) file->Add(row);
  };
  try {
    file.emplace(options, logs::ForEachMappedRow(*source.log, mapping, resolver, pass).groups);
    const logs::MappingReport report = logs::ForEachMappedRow(*source.log, mapping, resolver, pass);
    result.remarks.push_back("mapping " + report.mapping);
    for (const logs::LogProblem& problem : report.problems)
      result.remarks.push_back(fmt::format("{}: {}", problem.file.string(), problem.what));
    result.files.push_back(file->Publish());
  } catch (const Interruption&) {
    result.was_interrupted = true;
  }
  return result;
}

}  // namespace

ExportResult ExportSignals(const ExportOptions& options) {
  const ExportSource source = OpenExport(options);
  const bool own = !options.mapping && logs::HasOwnRows(source.log->contents());
  return own ? ExportOwnRows(options, source) : ExportMappedRows(options, source);
}

}  // namespace scoria::app
