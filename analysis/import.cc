// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/import.h"

#include "core/log/mcap.h"
#include "core/log/messages.h"

namespace scoria::analysis {

LogContent ReadLog(const std::filesystem::path& log, int every) {
  LogContent content;
  long seen = 0;
  const auto take = [&](const core::McapReader::Message& m) {
    if (m.channel.topic == "/scoria/row") {
      if (seen++ % every == 0) content.rows.push_back(core::DecodeCdr<core::LogRow>(m.data));
    } else if (m.channel.topic == "/scoria/event") {
      const auto event = core::DecodeCdr<core::msg::Event>(m.data);
      if (event.kind == "fall") content.falls_s.push_back(static_cast<double>(m.time_ns) * 1e-9);
    }
    return true;
  };
  try {
    content.problem = core::McapReader(log).ForEachMessage(take);
  } catch (const std::exception& e) {
    content.problem = e.what();
  }
  return content;
}

}  // namespace scoria::analysis
