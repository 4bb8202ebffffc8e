// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/field_catalog.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "logs/format/csv_log.h"
#include "logs/mapping/vocabulary.h"
#include "logs/ros/message_error.h"
#include "logs/ros/visit_leaves.h"

namespace scoria::logs {
namespace {

constexpr std::size_t kMostValues = 512;
constexpr std::uint64_t kMostMessages = 200'000;

/// Fills the catalogue of one channel.
class ChannelCatalog {
 public:
  ChannelCatalog(const LogChannel& channel, const TypeResolver& resolver)
      : splitter_(channel.message_encoding == kCsvEncoding ? CsvLayoutOf(channel).separator : ',') {
    topic_.topic = channel.topic;
    topic_.type = FullTypeName(channel.type_name);
    topic_.is_csv = channel.message_encoding == kCsvEncoding;
    if (topic_.is_csv) {
      layout_ = CsvLayoutOf(channel);
      topic_.has_names = !layout_.names.empty();
      for (std::size_t i = 0; i < layout_.columns; ++i)
        topic_.fields.push_back({topic_.has_names ? layout_.names[i] : fmt::to_string(i), {}});
      return;
    }
    const LogSchema schema = channel.schema.value_or(LogSchema{});
    type_ = resolver.Resolve(
        {channel.type_name, channel.message_encoding, schema.encoding, schema.text});
  }

  [[nodiscard]] bool IsFull() const { return num_messages_ >= kMostValues; }
  [[nodiscard]] CatalogTopic& topic() { return topic_; }

  void Add(const LogMessage& message) {
    if (num_messages_++ >= kMostValues) return;
    if (topic_.is_csv) return AddLine(message);
    type_->Show(message.data);
    const TypeCandidate* taken = type_->taken();
    if (taken == nullptr) return;
    try {
      VisitLeaves(taken->type, message.data,
                  [&](const LeafPath& path, const FieldView& view) { AddLeaf(path.Text(), view); });
    } catch (const MessageError&) {  // the reader of rows says so
    }
  }

 private:
  void AddLine(const LogMessage& message) {
    const auto fields =
        splitter_.Split({reinterpret_cast<const char*>(message.data.data()), message.data.size()});
    for (std::size_t i = 0; i < std::min(fields.size(), topic_.fields.size()); ++i) {
      if (const auto value = ParseCsvNumber(fields[i])) topic_.fields[i].values.push_back(*value);
    }
  }

  void AddLeaf(const std::string& path, const FieldView& view) {
    if (IsText(view.type())) {
      if (num_messages_ > 1 || view.size() < 12) return;
      topic_.text_arrays.push_back(path);
      topic_.texts.push_back(view.Texts());
      return;
    }
    constexpr std::size_t kLongest = 256;  // images and clouds are no signals
    const bool is_signal = view.size() > 0 && view.size() <= kLongest;
    for (std::size_t i = 0; is_signal && i < view.size(); ++i) {
      const std::string name = view.size() == 1 ? path : fmt::format("{}[{}]", path, i);
      const auto [at, is_new] = index_.try_emplace(name, topic_.fields.size());
      if (is_new) topic_.fields.push_back({name, {}});
      topic_.fields[at->second].values.push_back(view.Double(i));
    }
  }

  CatalogTopic topic_;
  CsvLayout layout_;
  CsvSplitter splitter_;
  std::optional<TypeChoice> type_;
  std::map<std::string, std::size_t> index_;  // in topic_.fields
  std::uint64_t num_messages_ = 0;
};

/// A part of a field's name that a placeholder can stand for.
struct Part {
  std::size_t at = 0, size = 0;
};

bool IsAlpha(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool IsDigitChar(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Words of letters, and runs of digits.
std::vector<Part> PartsOf(const std::string& name) {
  std::vector<Part> parts;
  for (std::size_t at = 0; at < name.size();) {
    std::size_t end = at;
    while (end < name.size() && IsAlpha(name[end])) ++end;
    if (end == at) {
      while (end < name.size() && IsDigitChar(name[end])) ++end;
    }
    if (end > at) parts.push_back({at, end - at});
    at = std::max(end, at + 1);
  }
  return parts;
}

bool IsJointWord(const std::string& word) {
  const std::vector<std::string> names = {"FL_" + word};
  return JointsNamed(names)[0].has_value() && !LegNamed(word);
}

/// A name with a placeholder in place of parts of it, and what these were.
struct Abstraction {
  std::string pattern;
  std::string leg, joint, axis;
  std::optional<std::size_t> index;
};

std::string Replaced(std::string name, Part part, const char* placeholder) {
  return name.replace(part.at, part.size, placeholder);
}

/// Every axis letter at the end or beginning of a word, or a word of its own.
void AddAxes(const Abstraction& base, const std::vector<Part>& parts,
             std::vector<Abstraction>& out) {
  for (const Part& part : parts) {
    for (const std::size_t at : {part.at + part.size - 1, part.at}) {
      const char letter = base.pattern[at];
      const bool is_axis = (letter >= 'w' && letter <= 'z') && IsAlpha(letter);
      const bool is_inside = at > 0 && base.pattern[at - 1] == '{';
      if (!is_axis || is_inside) continue;
      Abstraction more = base;
      more.axis = std::string(1, letter);
      more.pattern = Replaced(base.pattern, {at, 1}, "{axis}");
      out.push_back(std::move(more));
      if (part.size == 1) break;
    }
  }
}

std::vector<Abstraction> AbstractionsOf(const std::string& name) {
  const std::vector<Part> parts = PartsOf(name);
  std::vector<Abstraction> out;
  AddAxes({name, "", "", "", std::nullopt}, parts, out);
  for (const Part& leg : parts) {
    const std::string leg_text = name.substr(leg.at, leg.size);
    if (IsDigitChar(leg_text[0])) {
      std::size_t index = 0;
      if (leg_text.size() < 5) index = std::stoul(leg_text);
      out.push_back({Replaced(name, leg, "{i}"), "", "", "", index});
      continue;
    }
    if (!LegNamed(leg_text) || leg_text.size() > 10) continue;
    const Abstraction with_leg{Replaced(name, leg, "{leg}"), leg_text, "", "", std::nullopt};
    out.push_back(with_leg);
    std::vector<Part> others = PartsOf(with_leg.pattern);
    std::erase_if(others,
                  [&](const Part& p) { return p.at > 0 && with_leg.pattern[p.at - 1] == '{'; });
    AddAxes(with_leg, others, out);
    for (const Part& joint : others) {
      const std::string joint_text = with_leg.pattern.substr(joint.at, joint.size);
      if (!IsJointWord(joint_text)) continue;
      out.push_back(
          {Replaced(with_leg.pattern, joint, "{joint}"), leg_text, joint_text, "", std::nullopt});
    }
  }
  return out;
}

/// The members of a pattern, with what its placeholders stood for.
struct Candidates {
  std::vector<Abstraction> names;
  std::vector<const CatalogField*> fields;
};

void AddOnce(std::vector<std::string>& list, const std::string& text) {
  if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end())
    list.push_back(text);
}

std::optional<FieldFamily> FamilyOf(const std::string& pattern, const Candidates& candidates) {
  FieldFamily family{pattern, {}, {}, {}, candidates.fields};
  for (const Abstraction& a : candidates.names) {
    AddOnce(family.legs, a.leg);
    AddOnce(family.joints, a.joint);
    AddOnce(family.axes, a.axis);
  }
  if (candidates.names.front().index) {
    const std::size_t first = *candidates.names.front().index;
    for (std::size_t k = 0; k < candidates.names.size(); ++k) {
      if (candidates.names[k].index != first + k) return std::nullopt;
    }
    if (candidates.names.size() != 3 && candidates.names.size() != 4 &&
        candidates.names.size() < 12)
      return std::nullopt;
    if (first > 0) {
      const std::size_t at = family.pattern.find("{i}");
      family.pattern.replace(at, 3, fmt::format("{{i+{}}}", first));
    }
    return family;
  }
  const std::size_t legs = std::max<std::size_t>(family.legs.size(), 1),
                    joints = std::max<std::size_t>(family.joints.size(), 1),
                    axes = std::max<std::size_t>(family.axes.size(), 1);
  const bool has_three = family.axes.empty() || axes == 3 || axes == 4;
  const bool is_whole = (family.legs.empty() || legs == 4) &&
                        (family.joints.empty() || joints == 3) && has_three &&
                        family.fields.size() == legs * joints * axes && family.fields.size() > 1;
  return is_whole ? std::optional(family) : std::nullopt;
}

}  // namespace

std::vector<CatalogTopic> CatalogFields(LogSource& log, const TypeResolver& resolver) {
  std::vector<ChannelCatalog> channels;
  for (const LogChannel& channel : log.contents().channels)
    channels.emplace_back(channel, resolver);
  std::uint64_t num_messages = 0;
  log.ForEach({}, [&](const LogMessage& message) {
    channels[message.channel_index].Add(message);
    const bool all_full = std::all_of(channels.begin(), channels.end(),
                                      [](const ChannelCatalog& c) { return c.IsFull(); });
    return !all_full && ++num_messages < kMostMessages;
  });
  std::vector<CatalogTopic> topics;
  for (ChannelCatalog& channel : channels) topics.push_back(std::move(channel.topic()));
  return topics;
}

std::vector<FieldFamily> FindFamilies(const CatalogTopic& topic) {
  std::vector<std::string> patterns;  // in the order of the message
  std::map<std::string, Candidates> by_pattern;
  for (const CatalogField& field : topic.fields) {
    for (Abstraction& a : AbstractionsOf(field.path)) {
      if (!by_pattern.contains(a.pattern)) patterns.push_back(a.pattern);
      Candidates& candidates = by_pattern[a.pattern];
      candidates.fields.push_back(&field);
      candidates.names.push_back(std::move(a));
    }
  }
  std::vector<FieldFamily> families;
  for (const std::string& pattern : patterns) {
    if (auto family = FamilyOf(pattern, by_pattern.at(pattern)))
      families.push_back(std::move(*family));
  }
  std::stable_sort(families.begin(), families.end(),
                   [](const auto& a, const auto& b) { return a.fields.size() > b.fields.size(); });
  return families;
}

}  // namespace scoria::logs
