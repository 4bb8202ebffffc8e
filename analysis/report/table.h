// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/document.h"
#include "analysis/statistics/rate.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// A column of a table: its title, and what it says of a line.
template <class Line>
struct Column {
  const char* title = "";
  std::string (*text)(const Line& line) = nullptr;
};

/// @param columns  a range of Column<Line>.
template <class Line, class Columns>
[[nodiscard]] Table TableOf(const std::vector<Line>& lines, const Columns& columns) {
  Table table;
  for (const Column<Line>& column : columns) table.header.emplace_back(column.title);
  for (const Line& line : lines) {
    std::vector<std::string>& row = table.rows.emplace_back();
    for (const Column<Line>& column : columns) row.push_back(column.text(line));
  }
  return table;
}

/// Likewise, after the columns of the sweep and of the arm.
/// @param lines  each with `point` and `arm`.
template <class Line, class Columns>
[[nodiscard]] Table PointTable(const std::vector<Axis>& axes, const std::vector<Line>& lines,
                               const Columns& columns) {
  Table table = TableOf(lines, columns);
  std::vector<std::string> lead;
  for (const Axis& axis : axes) lead.push_back(axis.label);
  lead.emplace_back("arm");
  table.header.insert(table.header.begin(), lead.begin(), lead.end());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lead = lines[i].point;
    lead.push_back(lines[i].arm);
    table.rows[i].insert(table.rows[i].begin(), lead.begin(), lead.end());
  }
  return table;
}

/// By name and arm.
using ArmCounts = std::map<std::string, std::map<std::string, std::uint64_t>>;
[[nodiscard]] Table CountTable(const std::string& title, const ArmCounts& counts,
                               const std::vector<std::string>& arms);

/// The value where there is something to show.
[[nodiscard]] std::optional<double> When(bool any, double value);

/// A dash for nothing and for what is not finite.
[[nodiscard]] std::string NumberText(std::optional<double> value, int digits);

/// "7 in 503 m".
[[nodiscard]] std::string CountText(const RateEstimate& falls);

/// "0.032", "< 0.0001".
[[nodiscard]] std::string PValueText(double p);

/// In per cent, without the sign.
[[nodiscard]] std::string ShareText(std::uint64_t part, std::uint64_t whole, int digits);

}  // namespace scoria::analysis
