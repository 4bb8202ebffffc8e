// SPDX-License-Identifier: BSD-3-Clause
#include "logs/csv_line.h"

#include <fmt/format.h>

namespace scoria::logs {

std::string CsvLine(std::span<const std::string> cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    if (cells[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += cells[i];
      continue;
    }
    line += '"';
    for (const char c : cells[i]) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + '\n';
}

std::string SecondsText(std::int64_t time_ns) {
  constexpr std::uint64_t kNsPerS = 1'000'000'000;
  const auto bits = static_cast<std::uint64_t>(time_ns);
  const std::uint64_t magnitude = time_ns < 0 ? ~bits + 1 : bits;
  return fmt::format("{}{}.{:09}", time_ns < 0 ? "-" : "", magnitude / kNsPerS,
                     magnitude % kNsPerS);
}

}  // namespace scoria::logs
