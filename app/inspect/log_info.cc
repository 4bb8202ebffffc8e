// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/log_info.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file_kind.h"
#include "core/text.h"
#include "logs/format/csv_log.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using logs::ChannelSurvey;
using logs::ClockSurvey;
using logs::LogChannel;
using logs::LogProblem;
using nlohmann::json;

constexpr std::int64_t kNsPerS = 1'000'000'000;
constexpr double kMsPerS = 1e3, kPercent = 100.0;

/// Later receive times are dates, not seconds since a start: 1973.
constexpr std::int64_t kFirstDate_ns = 100'000'000 * kNsPerS;

std::string TimeText(std::int64_t time_ns) {
  if (time_ns < kFirstDate_ns) return fmt::format("{:.3f} s", 1e-9 * static_cast<double>(time_ns));
  const std::time_t time_s = time_ns / kNsPerS;
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} UTC", fmt::gmtime(time_s),
                     time_ns % kNsPerS / 1'000'000);
}

double LengthOf_s(const logs::LogSpan& span) {
  return 1e-9 * (static_cast<double>(span.last_ns) - static_cast<double>(span.first_ns));
}

/// Regular files of a path; none if there are none.
std::uint64_t BytesOf(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return fs::file_size(path, error);
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(path, error)) {
    if (entry.is_regular_file(error)) bytes += entry.file_size(error);
  }
  return bytes;
}

const char* CostOf(LogProblem::Kind kind) {
  switch (kind) {
    case LogProblem::Kind::kCut:
      return "its end is missing";
    case LogProblem::Kind::kLost:
      return "a part is missing";
    case LogProblem::Kind::kOdd:
      break;
  }
  return "nothing is missing for it";
}

// --- The table ---

using Cells = std::vector<std::string>;

constexpr std::size_t kLeftCells = 2;  // topic and type; the last cell as well
const std::array<Cells, 2> kTitles = {
    Cells{"", "", "", "receive", "", "", "", "header", "", "", "", "receive", ""},
    Cells{"topic", "type", "messages", "Hz", "span s", "regular", "back", "Hz", "span s", "regular",
          "back", "- header ms", "definition"}};

void AppendClock(const std::optional<ClockSurvey>& clock, Cells& cells) {
  const auto add = [&](bool known, const auto& text) {
    cells.push_back(known ? text() : std::string("-"));
  };
  add(clock && clock->rate_Hz(), [&] { return fmt::format("{:.1f}", *clock->rate_Hz()); });
  add(clock && clock->span, [&] { return fmt::format("{:.3f}", LengthOf_s(*clock->span)); });
  add(clock && clock->regular_share,
      [&] { return fmt::format("{:.0f} %", kPercent * *clock->regular_share); });
  add(clock && clock->span, [&] { return fmt::format("{}", clock->backward); });
}

Cells RowOf(const LogChannel& channel, const ChannelSurvey& survey) {
  Cells cells = {core::Shown(channel.topic), core::Shown(channel.type_name),
                 fmt::format("{}", survey.messages)};
  AppendClock(survey.receive, cells);
  AppendClock(survey.header, cells);
  cells.push_back(survey.receive_after_header
                      ? fmt::format("{:.3f}", kMsPerS * survey.receive_after_header->median_s)
                      : "-");
  const logs::TypeCandidate* const taken = survey.type.taken();
  if (survey.is_table) {
    cells.push_back(fmt::format("{} columns", logs::CsvLayoutOf(channel).columns));
  } else {
    cells.push_back(taken == nullptr ? "not decoded" : taken->origin);
  }
  return cells;
}

std::string TableText(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const char* const gap = i == 0 ? "" : "  ";
      if (i + 1 == row.size()) {
        line += gap + row[i];
      } else if (i < kLeftCells) {
        line += fmt::format("{}{:<{}}", gap, row[i], widths[i]);
      } else {
        line += fmt::format("{}{:>{}}", gap, row[i], widths[i]);
      }
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

// --- What is wrong ---

/// Of one channel, in words.
std::vector<std::string> RemarksOn(const LogChannel& channel, const ChannelSurvey& survey) {
  std::vector<std::string> remarks;
  const logs::TypeCandidate* const taken = survey.type.taken();
  const std::string report = survey.type.Report();
  if (!survey.IsDecoded()) {
    remarks.push_back("not decoded: " + report);
  } else if (taken != nullptr && report != taken->origin) {
    remarks.push_back("decoded by " + report);
  }
  if (taken != nullptr && taken->misfits == 0 && survey.undecoded > 0)
    remarks.push_back(fmt::format("{} of {} messages cannot be decoded: {}", survey.undecoded,
                                  survey.messages, survey.first_undecoded));
  if (channel.message_count && *channel.message_count != survey.messages)
    remarks.push_back(fmt::format("{} of the {} messages that the log announces are there",
                                  survey.messages, *channel.message_count));
  return remarks;
}

std::string HeadText(const logs::LogContents& contents, const logs::LogSurvey& survey) {
  std::size_t decoded = 0;
  for (const ChannelSurvey& channel : survey.channels) decoded += channel.IsDecoded() ? 1 : 0;
  std::string text = fmt::format("{}: {}, {:.3f} MB\n", contents.path.string(), contents.format,
                                 1e-6 * static_cast<double>(BytesOf(contents.path)));
  text += survey.span
              ? fmt::format("  recorded     {} to {}, {:.3f} s\n", TimeText(survey.span->first_ns),
                            TimeText(survey.span->last_ns), LengthOf_s(*survey.span))
              : "  recorded     nothing\n";
  text += fmt::format("  messages     {} on {} topics, {} of them decoded\n", survey.messages,
                      survey.channels.size(), decoded);
  std::vector<std::string> metadata;
  for (const auto& [name, entries] : contents.metadata) metadata.push_back(core::Shown(name));
  if (!metadata.empty()) text += fmt::format("  metadata     {}\n", fmt::join(metadata, ", "));
  std::vector<std::string> attachments;
  for (const std::string& name : contents.attachments) attachments.push_back(core::Shown(name));
  if (!attachments.empty())
    text += fmt::format("  attachments  {}\n", fmt::join(attachments, ", "));
  return text;
}

// --- JSON ---

template <class T>
json OrNull(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

json ToJson(const std::optional<logs::LogSpan>& span) {
  if (!span) return nullptr;
  return {{"first_ns", span->first_ns}, {"last_ns", span->last_ns}};
}

json ToJson(const ClockSurvey& clock) {
  return {{"stamps", clock.stamps},
          {"span", ToJson(clock.span)},
          {"rate_Hz", OrNull(clock.rate_Hz())},
          {"longest_step_s", clock.longest_step_s},
          {"regular_share", OrNull(clock.regular_share)},
          {"backward", clock.backward},
          {"repeated", clock.repeated}};
}

json ToJson(const LogChannel& channel, const ChannelSurvey& survey) {
  const logs::TypeCandidate* const taken = survey.type.taken();
  json out = {{"topic", channel.topic},
              {"type", channel.type_name},
              {"message_encoding", channel.message_encoding},
              {"messages", survey.messages},
              {"announced_messages", OrNull(channel.message_count)},
              {"bytes", survey.bytes},
              {"receive", ToJson(survey.receive)},
              {"header", nullptr},
              {"receive_after_header", nullptr},
              {"definition", taken == nullptr ? json(nullptr) : json(taken->origin)},
              {"is_table", survey.is_table},
              {"report", survey.type.Report()},
              {"undecoded", survey.undecoded}};
  if (survey.header) {
    out["header"] = ToJson(*survey.header);
    out["header"]["field"] = survey.header_path;
  }
  if (const auto& difference = survey.receive_after_header)
    out["receive_after_header"] = {{"median_s", difference->median_s},
                                   {"smallest_s", difference->smallest_s},
                                   {"largest_s", difference->largest_s}};
  return out;
}

const char* NameOf(LogProblem::Kind kind) {
  switch (kind) {
    case LogProblem::Kind::kCut:
      return "cut";
    case LogProblem::Kind::kLost:
      return "lost";
    case LogProblem::Kind::kOdd:
      break;
  }
  return "odd";
}

/// Whether the first line that says something is a key of a YAML map, and none of a rosbag2's.
bool LooksLikeConfig(std::string_view head) {
  if (head.find('\0') != std::string_view::npos) return false;
  while (!head.empty()) {
    const std::string_view line = head.substr(0, head.find('\n'));
    head.remove_prefix(std::min(head.size(), line.size() + 1));
    const std::size_t start = line.find_first_not_of(" \t\r");
    const bool says_nothing =
        start == std::string_view::npos || line[start] == '#' || line.starts_with("---");
    if (says_nothing) continue;
    const std::string_view key = line.substr(start, line.find(':') - start);
    const bool is_key =
        key.size() < line.size() - start && key.find_first_of(" \t,;\"") == std::string_view::npos;
    return is_key && key != "rosbag2_bagfile_information";
  }
  return false;
}

}  // namespace

bool IsTakenForLog(const fs::path& path) {
  if (fs::is_directory(path)) return true;
  std::ifstream in(path, std::ios::binary);
  if (!in) return path.extension() != ".yaml" && path.extension() != ".yml";
  constexpr std::size_t kHead = 4096;
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const core::FileKind kind = core::KindOfContent(head);
  if (kind.name == core::kUrdf || kind.name == core::kXacro) return false;
  return !kind.name.empty() || !LooksLikeConfig(head);
}

std::string LogInfoText(const logs::LogSource& log, const logs::LogSurvey& survey) {
  const logs::LogContents& contents = log.contents();
  std::vector<Cells> table(kTitles.begin(), kTitles.end());
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < survey.channels.size(); ++i) {
    const LogChannel& channel = contents.channels[i];
    table.push_back(RowOf(channel, survey.channels[i]));
    for (const std::string& remark : RemarksOn(channel, survey.channels[i]))
      remarks.push_back(fmt::format("{}: {}", core::Shown(channel.topic), remark));
  }
  std::sort(table.begin() + kTitles.size(), table.end());
  std::string text = HeadText(contents, survey);
  if (!survey.channels.empty()) text += '\n' + TableText(table);
  if (!remarks.empty() || !log.problems().empty()) text += '\n';
  for (const std::string& remark : remarks) text += remark + '\n';
  for (const LogProblem& problem : log.problems())
    text += fmt::format("{}: {} ({})\n", problem.file.string(), problem.what, CostOf(problem.kind));
  return text;
}

json LogInfoJson(const logs::LogSource& log, const logs::LogSurvey& survey) {
  const logs::LogContents& contents = log.contents();
  json out = {{"log", contents.path.string()},
              {"format", contents.format},
              {"bytes", BytesOf(contents.path)},
              {"messages", survey.messages},
              {"span", ToJson(survey.span)},
              {"metadata", contents.metadata},
              {"attachments", contents.attachments},
              {"topics", json::array()},
              {"problems", json::array()}};
  for (std::size_t i = 0; i < survey.channels.size(); ++i)
    out["topics"].push_back(ToJson(contents.channels[i], survey.channels[i]));
  for (const LogProblem& problem : log.problems())
    out["problems"].push_back(
        {{"kind", NameOf(problem.kind)}, {"file", problem.file.string()}, {"what", problem.what}});
  return out;
}

}  // namespace scoria::app
