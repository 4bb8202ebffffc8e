// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/logs.h"

#include <map>

#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/row.h"

namespace scoria::test {

void CopyLog(const std::filesystem::path& from, const std::filesystem::path& to,
             const std::function<bool(const std::string& topic)>& keep) {
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(from);
  logs::McapWriter writer(to);
  for (const auto& [name, metadata] : log->contents().metadata) writer.AddMetadata(name, metadata);
  std::map<std::string, std::uint16_t> channels;
  log->ForEach({.order = logs::LogOrder::kStored}, [&](const logs::LogMessage& m) {
    if (!keep(m.channel.topic)) return;
    if (!channels.contains(m.channel.topic))
      channels[m.channel.topic] =
          writer.AddChannel(m.channel.topic, m.channel.type_name, m.channel.schema->text);
    writer.Write(channels[m.channel.topic], m.log_time_ns, m.data);
  });
}

bool IsTruthTopic(const std::string& topic) {
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (logs::IsTruth(group) && topic == logs::TopicOf(group)) return true;
  }
  return false;
}

}  // namespace scoria::test
