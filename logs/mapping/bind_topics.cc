// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/bind_topics.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/format/csv_log.h"
#include "logs/ros/definition.h"

namespace scoria::logs {
namespace {

using Names = std::vector<std::string>;

bool Has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string SectionOf(std::string_view key) { return std::string(key.substr(0, key.find('.'))); }

class TopicFinder {
 public:
  TopicFinder(const Mapping& mapping, const LogContents& contents)
      : mapping_(mapping), contents_(contents) {}

  TopicBinding Bind() {
    CheckBase();
    for (const auto& [name, spec] : mapping_.file().topics) (void)TopicNamed(name, "");
    for (std::size_t i = 0; i < mapping_.signals().size(); ++i) {
      const SignalSpec& signal = mapping_.signals()[i];
      const std::string key = SectionOf(TraitsOf(signal.id).key);
      const auto at = TopicNamed(NameFor(signal, key), key + ".topic");
      if (at) binding_.topics[*at].signals.push_back(i);
    }
    return std::move(binding_);
  }

 private:
  void CheckBase() const {
    const std::string& base = mapping_.file().base_topic;
    if (base.empty()) return;
    Names names;
    for (const auto& [name, spec] : mapping_.file().topics) names.push_back(name);
    for (const SignalSpec& signal : mapping_.signals()) names.push_back(signal.topic);
    if (!Has(names, base))
      throw mapping_.ErrorAt("base_topic", fmt::format("\"{}\" is no topic of this mapping{}", base,
                                                       core::DidYouMean(base, names)));
  }

  /// The topic that a signal names, or the only one that there is.
  [[nodiscard]] std::string NameFor(const SignalSpec& signal, const std::string& section) const {
    const auto& topics = mapping_.file().topics;
    if (!signal.topic.empty()) return signal.topic;
    if (topics.size() == 1) return topics.begin()->first;
    if (topics.empty() && contents_.channels.size() == 1) return contents_.channels[0].topic;
    Names names;
    for (const auto& [name, spec] : topics) names.push_back(name);
    if (names.empty()) {
      for (const LogChannel& channel : contents_.channels) names.push_back(channel.topic);
    }
    throw mapping_.ErrorAt(section,
                           fmt::format("needs a topic; there are: {}", fmt::join(names, ", ")));
  }

  /// Index in the binding; nothing where an optional topic is absent.
  std::optional<std::size_t> TopicNamed(const std::string& name, const std::string& key) {
    const auto known = std::find_if(found_.begin(), found_.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    if (known != found_.end()) return known->second;
    const auto spec = mapping_.file().topics.find(name);
    const bool is_declared = spec != mapping_.file().topics.end();
    const std::optional<BoundTopic> topic =
        is_declared ? Find(spec->second, "topics." + name) : FindByName(name, key);
    std::optional<std::size_t> at;
    if (topic) {
      at = binding_.topics.size();
      binding_.topics.push_back(*topic);
      binding_.topics.back().name = name;
    } else {
      binding_.absent.push_back(DescribeLack(name, spec->second));
    }
    found_.emplace_back(name, at);
    return at;
  }

  [[nodiscard]] BoundTopic FindByName(const std::string& name, const std::string& key) const {
    TopicSpec spec;
    spec.names = {name};
    const std::vector<BoundTopic> fitting = Fitting(spec);
    if (!fitting.empty()) return fitting.front();
    Names known;
    for (const auto& [alias, unused] : mapping_.file().topics) known.push_back(alias);
    for (const LogChannel& channel : contents_.channels) known.push_back(channel.topic);
    throw mapping_.ErrorAt(
        key, fmt::format("the log has no topic \"{}\"{}", name, core::DidYouMean(name, known)));
  }

  /// The topics of the log that a specification allows.
  [[nodiscard]] std::vector<BoundTopic> Fitting(const TopicSpec& spec) const {
    std::vector<BoundTopic> topics;
    for (std::size_t i = 0; i < contents_.channels.size(); ++i) {
      const LogChannel& channel = contents_.channels[i];
      if (!Allows(spec, channel)) continue;
      const auto same = std::find_if(topics.begin(), topics.end(), [&](const BoundTopic& t) {
        const LogChannel& first = contents_.channels[t.channels.front()];
        return t.topic == channel.topic && first.type_name == channel.type_name;
      });
      if (same != topics.end()) {
        same->channels.push_back(i);
      } else {
        topics.push_back({"", channel.topic, {i}, {}, spec.max_age_s, !spec.type.empty()});
      }
    }
    return topics;
  }

  static bool Allows(const TopicSpec& spec, const LogChannel& channel) {
    const bool is_csv = channel.message_encoding == kCsvEncoding;
    if (!spec.type.empty() && FullTypeName(channel.type_name) != FullTypeName(spec.type))
      return false;
    if (spec.columns > 0 && (!is_csv || CsvLayoutOf(channel).columns != spec.columns)) return false;
    if (spec.type.empty() && spec.names.empty()) return is_csv;
    return !spec.type.empty() || Has(spec.names, channel.topic);
  }

  /// Of several topics of a type the one that is named first, or the only one.
  [[nodiscard]] std::optional<BoundTopic> Find(const TopicSpec& spec,
                                               const std::string& key) const {
    const std::vector<BoundTopic> fitting = Fitting(spec);
    for (const std::string& name : spec.names) {
      for (const BoundTopic& topic : fitting) {
        if (topic.topic == name) return topic;
      }
    }
    if (fitting.size() == 1) return fitting.front();
    if (spec.optional) return std::nullopt;
    if (fitting.empty()) throw mapping_.ErrorAt(key, DescribeAbsence(spec));
    throw mapping_.ErrorAt(key, fmt::format("the log has several such topics: {}; names: [...] "
                                            "says which",
                                            fmt::join(NamesOf(fitting), ", ")));
  }

  static Names NamesOf(const std::vector<BoundTopic>& topics) {
    Names names;
    for (const BoundTopic& topic : topics) names.push_back(topic.topic);
    return names;
  }

  /// Of an optional topic that is not taken.
  [[nodiscard]] std::string DescribeLack(const std::string& name, const TopicSpec& spec) const {
    const Names names = NamesOf(Fitting(spec));
    if (names.empty()) return name;
    return fmt::format("single {} ({} are there)", name, fmt::join(names, ", "));
  }

  [[nodiscard]] std::string DescribeAbsence(const TopicSpec& spec) const {
    Names topics, types;
    for (const LogChannel& channel : contents_.channels) {
      topics.push_back(channel.topic);
      if (!channel.type_name.empty()) types.push_back(FullTypeName(channel.type_name));
    }
    if (!spec.type.empty())
      return fmt::format("the log has no topic of type {}{}", spec.type,
                         core::DidYouMean(spec.type, types));
    if (!spec.names.empty())
      return fmt::format("the log has no topic {}{}", fmt::join(spec.names, ", "),
                         core::DidYouMean(spec.names.front(), topics));
    if (spec.columns > 0) return fmt::format("the log has no CSV file of {} columns", spec.columns);
    return "the log has no CSV file";
  }

  const Mapping& mapping_;
  const LogContents& contents_;
  TopicBinding binding_;
  std::vector<std::pair<std::string, std::optional<std::size_t>>> found_;
};

}  // namespace

TopicBinding BindTopics(const Mapping& mapping, const LogContents& contents) {
  return TopicFinder(mapping, contents).Bind();
}

}  // namespace scoria::logs
