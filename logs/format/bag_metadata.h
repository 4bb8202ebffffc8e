// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::logs {

inline constexpr const char* kBagMetadata = "metadata.yaml";

/// What metadata.yaml says of a topic.
struct BagTopic {
  std::uint64_t message_count = 0;
  std::string type_name, message_encoding;  // empty: not said
  bool operator==(const BagTopic&) const = default;
};

/// What rosbag2's metadata.yaml says of a bag: a hint, since it is written at the end of a
/// recording, by many versions and by hand. What a version has not, or has in another form, is
/// absent.
struct BagMetadata {
  std::vector<std::string> files;  // as written, with or without the bag's folder before them
  std::optional<std::uint64_t> message_count;
  std::map<std::string, BagTopic> topics;
  std::optional<LogSpan> span;
};

/// Reads the file, of whatever version. Source: [Rosbag2], versions 1 to 9.
/// Errors: std::runtime_error that says what is wrong with it.
[[nodiscard]] BagMetadata ReadBagMetadata(const std::filesystem::path& file);

/// In what the files of a bag differ from it, a sentence each.
[[nodiscard]] std::vector<std::string> CompareMetadata(const BagMetadata& metadata,
                                                       const LogContents& contents);

}  // namespace scoria::logs
