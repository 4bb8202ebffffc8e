// SPDX-License-Identifier: BSD-3-Clause
#include "logs/read_rows.h"

#include "logs/format/mcap.h"
#include "logs/messages/scoria.h"

namespace scoria::logs {

LogContent ReadLog(const std::filesystem::path& log, int every) {
  LogContent content;
  long seen = 0;
  const auto take = [&](const McapReader::Message& m) {
    if (m.channel.topic == "/scoria/row") {
      if (seen++ % every == 0) content.rows.push_back(DecodeCdr<LogRow>(m.data));
    } else if (m.channel.topic == "/scoria/event") {
      const auto event = DecodeCdr<msg::Event>(m.data);
      if (event.kind == "fall") content.falls_s.push_back(static_cast<double>(m.time_ns) * 1e-9);
    }
    return true;
  };
  try {
    content.problem = McapReader(log).ForEachMessage(take);
  } catch (const std::exception& e) {
    content.problem = e.what();
  }
  return content;
}

}  // namespace scoria::logs
