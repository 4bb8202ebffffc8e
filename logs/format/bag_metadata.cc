// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/bag_metadata.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/config/node.h"

namespace scoria::logs {
namespace {

using core::ConfigNode;

const ConfigNode* Find(const ConfigNode* node, std::string_view key) {
  return node == nullptr ? nullptr : node->Find(key);
}

std::optional<std::int64_t> IntOf(const ConfigNode* node) {
  if (node == nullptr || node->kind != ConfigNode::Kind::kScalar) return std::nullopt;
  std::int64_t value = 0;
  const char* end = node->scalar.data() + node->scalar.size();
  const auto [at, error] = std::from_chars(node->scalar.data(), end, value);
  return error == std::errc() && at == end ? std::optional(value) : std::nullopt;
}

std::optional<std::uint64_t> CountOf(const ConfigNode* node) {
  const std::optional<std::int64_t> value = IntOf(node);
  return value && *value >= 0 ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
}

/// Nothing also for the span of a bag without messages, which begins at the end of time.
std::optional<LogSpan> SpanOf(const ConfigNode& bag) {
  const auto start_ns = IntOf(Find(bag.Find("starting_time"), "nanoseconds_since_epoch"));
  const auto duration_ns = IntOf(Find(bag.Find("duration"), "nanoseconds"));
  if (!start_ns || !duration_ns) return std::nullopt;
  std::int64_t last_ns = 0;
  if (__builtin_add_overflow(*start_ns, *duration_ns, &last_ns)) return std::nullopt;
  return LogSpan{*start_ns, last_ns};
}

std::string TextOf(const ConfigNode* node) { return node == nullptr ? "" : node->scalar; }

void AddTopic(const ConfigNode& node, BagMetadata& metadata) {
  const ConfigNode* about = node.Find("topic_metadata");
  const ConfigNode* name = Find(about, "name");
  const auto count = CountOf(node.Find("message_count"));
  if (name == nullptr || !count) return;
  BagTopic& topic = metadata.topics[name->scalar];
  topic.message_count += *count;
  topic.type_name = TextOf(Find(about, "type"));
  topic.message_encoding = TextOf(Find(about, "serialization_format"));
}

/// What the files have of the topics, of channels on one topic the last.
std::map<std::string, BagTopic> TopicsOf(const LogContents& contents) {
  std::map<std::string, BagTopic> topics;
  for (const LogChannel& channel : contents.channels) {
    BagTopic& topic = topics[channel.topic];
    topic.message_count += channel.message_count.value_or(0);
    topic.type_name = channel.type_name;
    topic.message_encoding = channel.message_encoding;
  }
  return topics;
}

/// In what a topic is other than said; MCAP files lack topics without messages.
std::string DifferenceOf(const BagTopic& said, const std::optional<BagTopic>& there) {
  const BagTopic present = there.value_or(BagTopic{});
  std::vector<std::string> parts;
  if (present.message_count != said.message_count)
    parts.push_back(fmt::format("{}, not {}", present.message_count, said.message_count));
  for (const auto& [is, was] : {std::pair(present.type_name, said.type_name),
                                std::pair(present.message_encoding, said.message_encoding)}) {
    if (there && !was.empty() && is != was) parts.push_back(fmt::format("{}, not {}", is, was));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

BagMetadata ReadBagMetadata(const std::filesystem::path& file) {
  const ConfigNode root = core::LoadConfig(file);
  const ConfigNode* bag = root.Find("rosbag2_bagfile_information");
  if (bag == nullptr) throw std::runtime_error("has no rosbag2_bagfile_information");
  BagMetadata metadata;
  if (const ConfigNode* paths = bag->Find("relative_file_paths")) {
    for (const ConfigNode& path : paths->items) metadata.files.push_back(path.scalar);
  }
  metadata.message_count = CountOf(bag->Find("message_count"));
  if (metadata.message_count.value_or(0) > 0) metadata.span = SpanOf(*bag);
  if (const ConfigNode* topics = bag->Find("topics_with_message_count")) {
    for (const ConfigNode& topic : topics->items) AddTopic(topic, metadata);
  }
  return metadata;
}

std::vector<std::string> CompareMetadata(const BagMetadata& metadata, const LogContents& contents) {
  constexpr double kS = 1e-9;
  std::vector<std::string> differences;
  const bool all_counted =
      std::all_of(contents.channels.begin(), contents.channels.end(),
                  [](const LogChannel& channel) { return channel.message_count.has_value(); });
  if (!all_counted) return differences;  // they are not known without reading everything
  const std::map<std::string, BagTopic> present = TopicsOf(contents);
  std::uint64_t total = 0;
  for (const auto& [name, topic] : present) total += topic.message_count;
  if (metadata.message_count && *metadata.message_count != total)
    differences.push_back(
        fmt::format("counts {} messages, the files have {}", *metadata.message_count, total));
  std::vector<std::string> topics;
  for (const auto& [name, said] : metadata.topics) {
    const auto found = present.find(name);
    const std::string difference =
        DifferenceOf(said, found == present.end() ? std::nullopt : std::optional(found->second));
    if (!difference.empty()) topics.push_back(fmt::format("{} ({})", name, difference));
  }
  for (const auto& [name, topic] : present) {
    if (!metadata.topics.empty() && !metadata.topics.contains(name))
      topics.push_back(fmt::format("{} (it has none of that name)", name));
  }
  if (!topics.empty())
    differences.push_back(fmt::format("is wrong about {}", fmt::join(topics, ", ")));
  if (metadata.span && contents.span && *metadata.span != *contents.span)
    differences.push_back(fmt::format(
        "has other times: it begins {:+.3f} s and ends {:+.3f} s from the files' messages",
        kS * static_cast<double>(metadata.span->first_ns - contents.span->first_ns),
        kS * static_cast<double>(metadata.span->last_ns - contents.span->last_ns)));
  return differences;
}

}  // namespace scoria::logs
