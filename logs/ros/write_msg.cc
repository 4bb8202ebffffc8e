// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/write_msg.h"

#include <vector>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

/// "pkg/Name" of "pkg/msg/Name".
std::string PackageAndName(const std::string& full) {
  return fmt::format("{}/{}", full.substr(0, full.find('/')), ShortTypeName(full));
}

std::string TypeText(const MessageType& type, const Member& member) {
  std::string text = member.type == FieldType::kStruct ? PackageAndName(type.StructOf(member).name)
                                                       : std::string(NameOf(member.type));
  if (member.string_bound > 0) text += fmt::format("<={}", member.string_bound);
  switch (member.multiplicity) {
    case Multiplicity::kOne:
      break;
    case Multiplicity::kArray:
      text += fmt::format("[{}]", member.count);
      break;
    case Multiplicity::kSequence:
      text += member.count > 0 ? fmt::format("[<={}]", member.count) : "[]";
      break;
  }
  return text;
}

std::string FieldsText(const MessageType& type, const StructLayout& layout) {
  std::string text;
  for (const Member& member : layout.members) {
    if (!member.is_filler) text += fmt::format("{} {}\n", TypeText(type, member), member.name);
  }
  return text;
}

}  // namespace

std::string WriteRos2Msg(const MessageType& type) {
  constexpr int kSeparator = 80;
  std::string text = FieldsText(type, type.root());
  for (std::size_t i = 1; i < type.structs().size(); ++i) {
    const StructLayout& layout = type.structs()[i];
    text += fmt::format("{:=^{}}\nMSG: {}\n{}", "", kSeparator, PackageAndName(layout.name),
                        FieldsText(type, layout));
  }
  return text;
}

}  // namespace scoria::logs
