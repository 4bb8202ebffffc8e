// SPDX-License-Identifier: BSD-3-Clause
#include "logs/read_rows.h"

#include <fmt/format.h>

#include "logs/format/mcap.h"
#include "logs/messages/scoria.h"

namespace scoria::logs {
namespace {

/// "scoria 0.2.0", by the log's own account.
std::string WriterOf(const McapReader& reader) {
  for (const auto& [name, metadata] : reader.ReadMetadata()) {
    const auto version = metadata.find("version");
    if (version != metadata.end()) return "scoria " + version->second;
  }
  return "an unnamed program";
}

/// One pass over a log. @returns what is wrong with it.
std::string ReadMessages(const std::filesystem::path& log, const RowJoiner::OnRow& on_row,
                         const std::function<void(const McapReader::Message&)>& on_other) {
  try {
    McapReader reader(log);
    if (const std::string other = DescribeOtherLayout(reader); !other.empty())
      return fmt::format("{}: {}", log.string(), other);
    RowJoiner joiner(on_row);
    std::string problem = reader.ForEachMessage([&](const McapReader::Message& m) {
      if (!joiner.Add(m)) on_other(m);
      return true;
    });
    joiner.Finish();
    if (const std::string rows = DescribeRowProblems(reader, joiner); !rows.empty())
      problem += fmt::format("{}{}: {}", problem.empty() ? "" : "; ", log.string(), rows);
    return problem;
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

std::string DescribeRowProblems(const McapReader& reader, const RowJoiner& joiner) {
  std::string problems;
  const auto add = [&](const std::string& text) {
    problems += (problems.empty() ? "" : "; ") + text;
  };
  for (const auto& [topic, reason] : joiner.refused())
    add(fmt::format("{}, written by {}, is left out: {}", topic, WriterOf(reader), reason));
  if (joiner.goes_back_s())
    add(fmt::format("the rows go back in time, to {:.3f} s", *joiner.goes_back_s()));
  return problems;
}

std::map<std::string, std::string> MakeRowMetadata(const std::string& version) {
  return {{"schema_version", std::to_string(kRowSchemaVersion)}, {"version", version}};
}

std::string DescribeOtherLayout(const McapReader& reader) {
  const auto all = reader.ReadMetadata();
  const auto rows = all.find(kRowMetadata);
  if (rows == all.end()) return "";
  const auto version = rows->second.find("schema_version");
  const std::string theirs = version == rows->second.end() ? "unknown" : version->second;
  if (theirs == std::to_string(kRowSchemaVersion)) return "";
  return fmt::format("its rows are of layout {}, written by {}; this version reads layout {}",
                     theirs, WriterOf(reader), kRowSchemaVersion);
}

std::string ForEachRow(const std::filesystem::path& log,
                       const std::function<void(const Row&)>& on_row) {
  return ReadMessages(log, on_row, [](const McapReader::Message&) {});
}

LogContent ReadLog(const std::filesystem::path& log, int every) {
  LogContent content;
  long seen = 0;
  const auto on_row = [&](const Row& row) {
    if (seen++ % every == 0) content.rows.push_back(row);
  };
  const auto on_other = [&](const McapReader::Message& m) {
    if (m.channel.topic != "/scoria/event") return;
    const auto event = DecodeCdr<msg::Event>(m.data);
    if (event.kind == "fall") content.falls_s.push_back(static_cast<double>(m.time_ns) * 1e-9);
  };
  content.problem = ReadMessages(log, on_row, on_other);
  return content;
}

}  // namespace scoria::logs
