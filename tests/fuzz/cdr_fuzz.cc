// SPDX-License-Identifier: BSD-3-Clause
// Input: a ros2msg schema of pkg/msg/Type, a zero byte, a message.
#include <algorithm>
#include <string>
#include <vector>

#include "core/demand.h"
#include "logs/ros/check_message.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/message_error.h"
#include "logs/ros/visit_leaves.h"
#include "tests/fuzz/fuzz.h"
#include "tests/logs/ros/types.h"

namespace scoria::test {
namespace {

using Message = std::span<const std::byte>;

/// Reads the values of a message. @returns some of their paths.
std::vector<std::string> ReadAll(const logs::MessageType& type, Message message) {
  constexpr std::size_t kMostPaths = 40, kMostElements = 100;
  std::vector<std::string> paths;
  std::size_t length = 0;
  logs::VisitLeaves(type, message, [&](const logs::LeafPath& path, const logs::FieldView& view) {
    for (std::size_t i = 0; i < std::min(view.size(), kMostElements); ++i) {
      length += view.Element(i).Format().size();
      if (logs::IsNumber(view.type())) static_cast<void>(view.Double(i));
    }
    if (paths.size() < kMostPaths) paths.push_back(path.Text());
  });
  return paths;
}

bool Fits(const logs::MessageType& type, Message message) {
  try {
    logs::CheckMessage(type, message);
    return true;
  } catch (const logs::MessageError&) {
    return false;
  }
}

void Decode(const logs::MessageType& type, Message message) {
  const bool fits = Fits(type, message);
  try {
    const std::vector<std::string> paths = ReadAll(type, message);
    logs::FieldReader reader(type, paths);
    for (const logs::FieldView& view : reader.Read(message)) {
      SCORIA_DEMAND(!view.IsAbsent());  // every path was seen in this message
    }
  } catch (const logs::MessageError& error) {
    SCORIA_DEMAND(!fits, "{}", error.what());
  }
}

}  // namespace

void FuzzCdr(std::span<const std::uint8_t> input) {
  const auto zero = std::find(input.begin(), input.end(), 0);
  if (zero == input.end()) return;
  try {
    const logs::MessageType type = TypeOf(std::string(input.begin(), zero));
    // A copy of its own, so that a read beyond its end is seen by the address sanitizer.
    const std::vector<std::uint8_t> message(zero + 1, input.end());
    for (const int width : {4, 2}) {
      Decode(type.WithWideChars(width), std::as_bytes(std::span(message)));
      if (!type.has_wstring()) return;
    }
  } catch (const logs::DefinitionError&) {
  }
}

}  // namespace scoria::test

SCORIA_FUZZ_TARGET(FuzzCdr)
