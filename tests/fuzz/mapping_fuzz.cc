// SPDX-License-Identifier: BSD-3-Clause
// Input: a mapping file; it is held against a log of a few messages. After a line "===" the text of
// a CSV file may follow, which it then is held against.
#include <string>

#include "core/config/node.h"
#include "logs/format/csv_text.h"
#include "logs/mapping/mapped_rows.h"
#include "logs/messages/scoria.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/memory_log.h"

namespace scoria::test {
namespace {

MemoryLog Messages() {
  MemoryLog log;
  const std::size_t state = log.AddChannel("/quad_state", "interfaces/msg/QuadState"),
                    imu = log.AddChannel("/imu", "sensor_msgs/msg/Imu");
  for (int i = 0; i < 3; ++i) {
    log.AddMessage(state, i * 1'000'000, logs::msg::QuadState());
    log.AddMessage(imu, i * 1'000'000, logs::msg::Imu());
  }
  return log;
}

/// The lines of a table as a log, without a file.
MemoryLog Table(const std::string& text) {
  MemoryLog log;
  const auto dialect = logs::DetectCsv(text, true);
  if (!dialect) return log;
  log.AddTable("table", *dialect);
  std::size_t at = 0;
  for (std::int64_t line = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto* data = static_cast<const std::byte*>(static_cast<const void*>(text.data() + at));
    log.Add(0, line, {data, data + (end - at)});
    at = end + 1;
  }
  return log;
}

}  // namespace

void FuzzMapping(std::span<const std::uint8_t> input) {
  static const logs::TypeResolver kResolver;
  const std::string text(input.begin(), input.end());
  const std::string separator = "\n===\n";
  const std::size_t split = text.find(separator);
  MemoryLog log =
      split == std::string::npos ? Messages() : Table(text.substr(split + separator.size()));
  try {
    const logs::Mapping mapping = logs::ParseMapping(text.substr(0, split), "mapping.yaml");
    logs::ForEachMappedRow(log, mapping, kResolver, [](const logs::Row&) {});
  } catch (const core::ConfigError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzMapping)
