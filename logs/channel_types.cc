// SPDX-License-Identifier: BSD-3-Clause
#include "logs/channel_types.h"

#include "logs/ros/field_path.h"

namespace scoria::logs {

ChannelSchema SchemaOf(const LogChannel& channel) {
  return {channel.type_name, channel.message_encoding,
          channel.schema ? channel.schema->encoding : "",
          channel.schema ? channel.schema->text : ""};
}

std::vector<TypeChoice> ResolveTypes(const LogContents& contents, const TypeResolver& resolver) {
  std::vector<TypeChoice> types;
  for (const LogChannel& channel : contents.channels) {
    types.push_back(resolver.Resolve(SchemaOf(channel)));
  }
  return types;
}

std::optional<std::string> StampPathOf(const MessageType& type) {
  for (const char* path : {"header.stamp", "stamp"}) {
    try {
      if (ResolveField(type, path).type == FieldType::kTime) return path;
    } catch (const FieldPathError&) {
      // not in this type
    }
  }
  return std::nullopt;
}

}  // namespace scoria::logs
