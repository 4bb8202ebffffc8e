// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/labels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "core/files.h"
#include "core/text.h"

namespace scoria::app {
namespace {

std::string Trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::vector<std::string> CellsOf(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    cells.push_back(Trimmed(std::string_view(line).substr(start, comma - start)));
    start = comma + 1;
  }
  return cells;
}

LabelEntry ParseLine(const std::vector<std::string>& cells, const std::string& place) {
  LabelEntry entry;
  const std::string& time = cells[0];
  const auto [stop, error] =
      std::from_chars(time.data(), time.data() + time.size(), entry.label.time_s);
  if (error != std::errc{} || stop != time.data() + time.size() ||
      !std::isfinite(entry.label.time_s))
    throw std::runtime_error(
        fmt::format("{}: time: \"{}\" is no number of seconds", place, core::Shown(time)));
  const std::string verdict = cells.size() > 1 ? cells[1] : "";
  std::vector<std::string> choices;
  for (const auto& [value, name] : EnumNames(analysis::FallVerdict{})) {
    choices.emplace_back(name);
    if (name == verdict) {
      entry.label.verdict = value;
      if (cells.size() > 2) entry.log = cells[2];
      return entry;
    }
  }
  throw std::runtime_error(fmt::format("{}: verdict: unknown \"{}\"; choices: {}{}", place,
                                       core::Shown(verdict), fmt::join(choices, ", "),
                                       core::DidYouMean(verdict, choices)));
}

}  // namespace

std::vector<LabelEntry> ReadLabels(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw core::FileError(file, "cannot read", errno);
  std::vector<LabelEntry> entries;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::vector<std::string> cells = CellsOf(line);
    const bool says_nothing = cells.size() == 1 && cells[0].empty();
    if (says_nothing || (number == 1 && cells[0] == "time")) continue;
    entries.push_back(ParseLine(cells, fmt::format("{}:{}", file.string(), number)));
  }
  return entries;
}

std::vector<analysis::FallLabel> LabelsOf(const std::vector<LabelEntry>& entries,
                                          const std::string& log, double start_s) {
  constexpr double kSinceEpoch_s = 1e8;  // 1973: smaller times are row times
  std::vector<analysis::FallLabel> labels;
  for (const LabelEntry& entry : entries) {
    if (!entry.log.empty() && entry.log != log) continue;
    labels.push_back(entry.label);
    if (entry.label.time_s > kSinceEpoch_s) labels.back().time_s -= start_s;
  }
  std::sort(labels.begin(), labels.end(),
            [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return labels;
}

}  // namespace scoria::app
