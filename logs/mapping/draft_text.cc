// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/draft_text.h"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "logs/mapping/choose_mapping.h"

namespace scoria::logs {
namespace {

class DraftWriter {
 public:
  DraftWriter(const std::vector<CatalogTopic>& topics, const LogContents& contents,
              const DraftContent& content)
      : topics_(topics), contents_(contents), content_(content) {}

  std::string Write() {
    const std::string topics = Topics();  // names that the sections need
    return Header() + Legs() + topics + SectionTexts();
  }

 private:
  [[nodiscard]] std::string Header() const {
    std::string text =
        "# A draft: lines with a comment are guesses, and what is missing was not recognised.\n"
        "# docs/mappings.md tells every key.\n";
    try {
      text += fmt::format("# The shipped mapping {} fits this log.\n",
                          ChooseMapping(contents_, ShippedMappings()).name());
    } catch (const MappingChoiceError&) {  // then this draft is needed
    }
    return text;
  }

  [[nodiscard]] std::string Legs() const {
    std::string text;
    if (content_.legs.size() == 4) {
      text += fmt::format("legs: [{}]\n", fmt::join(content_.legs, ", "));
    } else if (const auto known = LegsOfKnownType(); !known.empty()) {
      text += fmt::format("legs: [{}]  # as robots with these messages have them\n",
                          fmt::join(known, ", "));
    } else if (content_.name_field.empty() && !Named("joints").empty()) {
      text += "legs: [FL, FR, HL, HR]  # the log does not name them: in the order of its arrays\n";
    }
    return text;
  }

  /// Of a shipped mapping for one of the log's types.
  [[nodiscard]] std::vector<std::string> LegsOfKnownType() const {
    for (const Mapping& mapping : ShippedMappings()) {
      if (!mapping.file().joints.name_field.empty() || mapping.file().joints.q == std::nullopt)
        continue;
      for (const auto& [name, spec] : mapping.file().topics) {
        for (const CatalogTopic& topic : topics_) {
          const bool is_its = !spec.type.empty() && FullTypeName(spec.type) == topic.type;
          if (is_its && topic.topic == JointTopic())
            return {mapping.file().legs.begin(), mapping.file().legs.end()};
        }
      }
    }
    return {};
  }

  [[nodiscard]] const std::vector<DraftSignal>& Named(const std::string& section) const {
    return std::find_if(content_.sections.begin(), content_.sections.end(),
                        [&](const auto& s) { return s.first == section; })
        ->second;
  }

  [[nodiscard]] std::string JointTopic() const {
    return Named("joints").empty() ? "" : Named("joints").front().topic;
  }

  /// Names for the topics: none for a CSV file alone.
  [[nodiscard]] std::string Topics() {
    if (topics_.size() == 1 && topics_[0].is_csv) return "";
    std::string text = "topics:\n";
    for (const CatalogTopic& topic : topics_) {
      if (!IsUsed(topic.topic)) {
        text += fmt::format("  # nothing recognised in {}\n", topic.topic);
        continue;
      }
      std::string name = AliasOf(topic.topic);
      const auto is_taken = [&](const auto& entry) { return entry.second == name; };
      while (std::any_of(aliases_.begin(), aliases_.end(), is_taken)) name += "_2";
      aliases_[topic.topic] = name;
      const std::string names = fmt::format("names: [{}]", QuotedInYaml(topic.topic));
      text += topic.is_csv
                  ? fmt::format("  {}: {{{}, columns: {}}}\n", name, names, topic.fields.size())
                  : fmt::format("  {}: {{type: {}, {}}}\n", name, topic.type, names);
    }
    return text;
  }

  /// "/robot/joint_states" as "robot_joint_states".
  static std::string AliasOf(const std::string& topic) {
    std::string name = topic;
    while (name.starts_with('/')) name.erase(0, 1);
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name.empty() ? "topic" : name;
  }

  [[nodiscard]] std::string SectionTexts() const {
    std::string text;
    for (const auto& [name, signals] : content_.sections) {
      if (!signals.empty()) text += SectionText(name, signals);
    }
    return text;
  }

  [[nodiscard]] std::string SectionText(const std::string& name,
                                        const std::vector<DraftSignal>& signals) const {
    // A section that is not complete is no use, but a hint.
    const bool has_contact = std::any_of(signals.begin(), signals.end(),
                                         [](const DraftSignal& s) { return s.key == "contact"; });
    const char* mark = name == "true_contacts" && !has_contact ? "# " : "";
    const std::string& topic = signals.front().topic;
    std::string text = fmt::format("{}{}:\n", mark, name);
    if (!aliases_.empty()) text += fmt::format("{}  topic: {}\n", mark, aliases_.at(topic));
    if (*mark != '\0') text += "#   contact:  # needed: which feet bear weight\n";
    if (name == "joints" && !content_.joints.empty())
      text += fmt::format("  names: [{}]\n", fmt::join(content_.joints, ", "));
    if (name == "joints" && !content_.name_field.empty())
      text += fmt::format("  name_field: {}\n", content_.name_field);
    if (name == "truth" && MayBeMarkers(topic))
      text += "  body: markers  # of a body on the trunk, not the trunk's frame\n";
    for (const DraftSignal& signal : signals) text += mark + SignalText(signal, topic);
    return text;
  }

  [[nodiscard]] std::string SignalText(const DraftSignal& signal, const std::string& topic) const {
    std::string options = signal.options;
    if (signal.topic != topic) options += ", topic: " + aliases_.at(signal.topic);
    const char* key = signal.field.starts_with('[') ? "fields" : "field";
    const std::string value = options.empty()
                                  ? signal.field
                                  : fmt::format("{{{}: {}{}}}", key, InFlow(signal.field), options);
    return fmt::format("  {}: {}{}\n", signal.key, value,
                       signal.comment.empty() ? "" : "  # " + signal.comment);
  }

  [[nodiscard]] static bool MayBeMarkers(const std::string& topic) {
    return HasAny(WordsOf(topic), {"vicon", "mocap", "optitrack"});
  }

  /// In braces brackets need quotes.
  static std::string InFlow(const std::string& field) {
    const bool is_open = !field.starts_with('"') && !field.starts_with('[') &&
                         field.find_first_of("{}[],") != std::string::npos;
    return is_open ? fmt::format("\"{}\"", field) : field;
  }

  [[nodiscard]] bool IsUsed(const std::string& topic) const {
    for (const auto& [name, signals] : content_.sections) {
      for (const DraftSignal& signal : signals) {
        if (signal.topic == topic) return true;
      }
    }
    return false;
  }

  const std::vector<CatalogTopic>& topics_;
  const LogContents& contents_;
  const DraftContent& content_;
  std::map<std::string, std::string> aliases_;  // by the log's topic
};

}  // namespace

std::string DraftText(const std::vector<CatalogTopic>& topics, const LogContents& contents,
                      const DraftContent& content) {
  return DraftWriter(topics, contents, content).Write();
}

std::string QuotedInYaml(const std::string& text) {
  const bool is_plain =
      !text.empty() && std::string_view("{[%&*!|>'\"@`#-?:, ").find(text[0]) == std::string::npos &&
      text.find(": ") == std::string::npos && text.find(" #") == std::string::npos;
  return is_plain ? text : fmt::format("\"{}\"", text);
}

std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    const auto u = static_cast<unsigned char>(c);
    if (depth > 0 || std::isalpha(u) == 0) {
      if (!words.back().empty()) words.emplace_back();
      continue;
    }
    words.back() += static_cast<char>(std::tolower(u));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool HasAny(const std::vector<std::string>& words, std::initializer_list<std::string_view> some) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(some.begin(), some.end(), word) != some.end();
  });
}

}  // namespace scoria::logs
