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
    for (const ConfigNode& topic : topics->items) {
      const ConfigNode* name = Find(topic.Find("topic_metadata"), "name");
      const auto count = CountOf(topic.Find("message_count"));
      if (name != nullptr && count) metadata.topic_counts[name->scalar] += *count;
    }
  }
  return metadata;
}

std::vector<std::string> CompareMetadata(const BagMetadata& metadata, const LogContents& contents) {
  constexpr double kS = 1e-9;
  std::vector<std::string> differences;
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t total = 0;
  for (const LogChannel& channel : contents.channels) {
    if (!channel.message_count) return differences;  // not known without reading everything
    counts[channel.topic] += *channel.message_count;
    total += *channel.message_count;
  }
  if (metadata.message_count && *metadata.message_count != total)
    differences.push_back(
        fmt::format("counts {} messages, the files have {}", *metadata.message_count, total));
  std::vector<std::string> topics;
  for (const auto& [topic, count] : metadata.topic_counts) {
    const auto found = counts.find(topic);
    const std::uint64_t present = found == counts.end() ? 0 : found->second;
    if (present != count) topics.push_back(fmt::format("{} ({}, not {})", topic, present, count));
  }
  for (const auto& [topic, count] : counts) {
    if (!metadata.topic_counts.empty() && !metadata.topic_counts.contains(topic))
      topics.push_back(fmt::format("{} (it has none of that name)", topic));
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
