// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scoria::logs {

/// A line of CSV with its end: cells separated by commas; in double quotes those that hold commas,
/// quotes or line ends. Source: [RFC4180], with a line feed alone at the end.
[[nodiscard]] std::string CsvLine(std::span<const std::string> cells);

/// A time in seconds with nine decimals, which no digit of it is lost to.
[[nodiscard]] std::string SecondsText(std::int64_t time_ns);

}  // namespace scoria::logs
