// SPDX-License-Identifier: BSD-3-Clause
#include "logs/read_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "logs/format/open_log.h"
#include "logs/messages/read_messages.h"
#include "logs/messages/scoria.h"

namespace scoria::logs {
namespace {

/// "scoria 0.2.0", by the log's own account.
std::string WriterOf(const LogSource& log) {
  for (const auto& [name, metadata] : log.contents().metadata) {
    const auto version = metadata.find("version");
    if (version != metadata.end()) return "scoria " + version->second;
  }
  return "an unnamed program";
}

bool HasRows(const LogContents& contents) {
  return std::any_of(contents.channels.begin(), contents.channels.end(),
                     [](const LogChannel& c) { return c.topic.starts_with(kRowTopics); });
}

/// One pass over a log. @returns what is wrong with it.
std::string ReadRows(const std::filesystem::path& path, const RowJoiner::OnRow& on_row,
                     const std::function<void(const LogMessage&)>& on_other) {
  try {
    const std::unique_ptr<LogSource> log = OpenLog(path);
    if (const std::string other = DescribeOtherLayout(*log); !other.empty())
      return fmt::format("{}: {}", path.string(), other);
    RowJoiner joiner(on_row);
    const auto take = [&](const LogMessage& m) {
      if (!joiner.Add(m)) on_other(m);
    };
    std::string problem = ProblemText(ReadMessages(*log, {.order = LogOrder::kStored}, take));
    joiner.Finish();
    if (const std::string rows = DescribeRowProblems(*log, joiner); !rows.empty())
      problem += fmt::format("{}{}: {}", problem.empty() ? "" : "; ", path.string(), rows);
    if (problem.empty() && !HasRows(log->contents()))
      problem =
          fmt::format("{}: holds no rows; logs of scoria do, with log.topics=all", path.string());
    return problem;
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

std::string DescribeRowProblems(const LogSource& log, const RowJoiner& joiner) {
  std::string problems;
  const auto add = [&](const std::string& text) {
    problems += (problems.empty() ? "" : "; ") + text;
  };
  for (const auto& [topic, reason] : joiner.refused())
    add(fmt::format("{}, written by {}, is left out: {}", topic, WriterOf(log), reason));
  if (joiner.goes_back_s())
    add(fmt::format("the rows go back in time, to {:.3f} s", *joiner.goes_back_s()));
  return problems;
}

std::map<std::string, std::string> MakeRowMetadata(const std::string& version) {
  return {{"schema_version", std::to_string(kRowSchemaVersion)}, {"version", version}};
}

std::string DescribeOtherLayout(const LogSource& log) {
  const auto& all = log.contents().metadata;
  const auto rows = all.find(kRowMetadata);
  if (rows == all.end()) return "";
  const auto version = rows->second.find("schema_version");
  const std::string theirs = version == rows->second.end() ? "unknown" : version->second;
  if (theirs == std::to_string(kRowSchemaVersion)) return "";
  return fmt::format("its rows are of layout {}, written by {}; this version reads layout {}",
                     theirs, WriterOf(log), kRowSchemaVersion);
}

std::string ForEachRow(const std::filesystem::path& log,
                       const std::function<void(const Row&)>& on_row) {
  return ReadRows(log, on_row, [](const LogMessage&) {});
}

LogContent ReadLog(const std::filesystem::path& log, int every) {
  LogContent content;
  long seen = 0;
  const auto on_row = [&](const Row& row) {
    if (seen++ % every == 0) content.rows.push_back(row);
  };
  const auto on_other = [&](const LogMessage& m) {
    if (m.channel.topic != "/scoria/event") return;
    const auto event = Decode<msg::Event>(m);
    if (event.kind == "fall") content.falls_s.push_back(static_cast<double>(m.log_time_ns) * 1e-9);
  };
  content.problem = ReadRows(log, on_row, on_other);
  return content;
}

}  // namespace scoria::logs
