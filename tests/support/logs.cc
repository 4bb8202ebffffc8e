// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/logs.h"

#include <map>

#include "logs/format/mcap.h"
#include "logs/row.h"

namespace scoria::test {

void CopyLog(const std::filesystem::path& from, const std::filesystem::path& to,
             const std::function<bool(const std::string& topic)>& keep) {
  logs::McapReader reader(from);
  logs::McapWriter writer(to);
  for (const auto& [name, metadata] : reader.ReadMetadata()) writer.AddMetadata(name, metadata);
  std::map<std::string, std::uint16_t> channels;
  (void)reader.ForEachMessage([&](const logs::McapReader::Message& m) {
    if (!keep(m.channel.topic)) return true;
    if (!channels.contains(m.channel.topic))
      channels[m.channel.topic] =
          writer.AddChannel(m.channel.topic, m.channel.type_name, m.channel.schema_text);
    writer.Write(channels[m.channel.topic], m.time_ns, m.data);
    return true;
  });
}

bool IsTruthTopic(const std::string& topic) {
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (logs::IsTruth(group) && topic == logs::TopicOf(group)) return true;
  }
  return false;
}

}  // namespace scoria::test
