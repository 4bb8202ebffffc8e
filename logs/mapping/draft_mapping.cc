// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/draft_mapping.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "logs/mapping/choose_mapping.h"
#include "logs/mapping/draft_numbers.h"
#include "logs/mapping/field_catalog.h"
#include "logs/mapping/vocabulary.h"

namespace scoria::logs {
namespace {

using Words = std::vector<std::string>;

/// Lower-case words of a text, placeholders and digits left out.
Words WordsOf(const std::string& text) {
  Words words(1);
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

bool HasAny(const Words& words, std::initializer_list<std::string_view> some) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(some.begin(), some.end(), word) != some.end();
  });
}

/// A pattern in YAML: quoted where YAML would take it for something else.
std::string Quoted(const std::string& text) {
  const bool is_plain =
      !text.empty() && std::string_view("{[%&*!|>'\"@`#-?:, ").find(text[0]) == std::string::npos &&
      text.find(": ") == std::string::npos && text.find(" #") == std::string::npos;
  return is_plain ? text : fmt::format("\"{}\"", text);
}

/// One line of a section: "  q: {field: ..., unit: deg}  # why".
struct DraftSignal {
  std::string key;
  std::string topic;
  std::string field;    // as YAML
  std::string options;  // ", unit: deg"
  std::string comment;
};

/// Sections in the order in which a mapping file has them.
using Sections = std::vector<std::pair<std::string, std::vector<DraftSignal>>>;

class Drafter {
 public:
  Drafter(const std::vector<CatalogTopic>& topics, const LogContents& contents)
      : topics_(topics), contents_(contents) {
    for (const char* name : {"joints", "imu", "feet", "battery", "joint_command", "estimate",
                             "truth", "true_contacts", "contacts", "command"})
      sections_.emplace_back(name, std::vector<DraftSignal>());
  }

  std::string Draft() {
    for (const CatalogTopic& topic : topics_) {
      if (topic.is_csv && !topic.has_names) {
        for (const NumberGuess& guess : GuessByNumbers(topic)) AddGuess(topic, guess);
        continue;
      }
      for (const FieldFamily& family : FindFamilies(topic)) AddFamily(topic, family);
      AddNamedScalars(topic);
    }
    const std::string topics = Topics();  // names that the sections need
    return Header() + Legs() + topics + SectionTexts();
  }

 private:
  std::vector<DraftSignal>& Section(const std::string& name) {
    return std::find_if(sections_.begin(), sections_.end(),
                        [&](const auto& section) { return section.first == name; })
        ->second;
  }

  /// The first field that is found for a signal is taken.
  bool Add(const std::string& section, DraftSignal signal) {
    std::vector<DraftSignal>& signals = Section(section);
    const bool is_known = std::any_of(signals.begin(), signals.end(),
                                      [&](const DraftSignal& s) { return s.key == signal.key; });
    if (is_known) return false;
    used_topics_.insert(signal.topic);
    signals.push_back(std::move(signal));
    return true;
  }

  void AddGuess(const CatalogTopic& topic, const NumberGuess& guess) {
    Add(guess.section, {guess.key, topic.topic, fmt::format("\"{{i+{}}}\"", guess.first),
                        guess.options, guess.why});
  }

  void AddFamily(const CatalogTopic& topic, const FieldFamily& family) {
    const Words words = WordsOf(family.pattern);
    const bool by_index = family.pattern.find("{i") != std::string::npos;
    const std::size_t size = family.fields.size();
    if (!family.joints.empty() || (by_index && size >= 12)) return AddJoints(topic, family, words);
    if (!family.legs.empty()) return AddFeet(topic, family, words);
    if (!family.axes.empty() || by_index) AddVector(topic, family, words);
  }

  void AddJoints(const CatalogTopic& topic, const FieldFamily& family, const Words& words) {
    const auto last = [&](std::initializer_list<std::string_view> some) {
      return !words.empty() && HasAny({words.back()}, some);
    };
    std::string key;
    if (last({"q", "pos", "position", "positions", "angle", "angles"}) ||
        (words.size() == 1 && words[0] == "q"))
      key = "q";
    if (last({"dq", "qd", "vel", "velocity", "velocities", "speed"}) || HasAny(words, {"dq", "qd"}))
      key = "qd";
    if (last({"tau", "torque", "torques", "effort", "est"}) || HasAny(words, {"tau", "torque"}))
      key = "tau";
    if (last({"kp", "kd"})) key = words.back();
    if (key.empty() && HasAny(words, {"q", "position"}) && !HasAny(words, {"raw"})) key = "q";
    if (key.empty() || HasAny(words, {"raw", "ddq", "temperature", "lost", "reserve"})) return;
    Words context = WordsOf(topic.type + " " + topic.topic);
    context.insert(context.end(), words.begin(), words.end());
    const bool is_command =
        HasAny(context, {"cmd", "command", "target", "des", "desired", "lowcmd", "jointcmd"});
    DraftSignal signal{key, topic.topic, "", "", ""};
    signal.field = Quoted(FieldOf(topic, family));
    if (key == "q") CheckAngles(family, signal);
    if (is_command && HasSentinel(family))
      signal.options += fmt::format(", absent: [{:g}]", family.fields[0]->values[0]);
    const bool is_gain = key == "kp" || key == "kd";
    if (is_gain && !is_command) return;
    if (!Add(is_command ? "joint_command" : "joints", signal)) return;
    if (family.legs.size() == 4) legs_ = family.legs;
    if (family.joints.size() == 3) OrderJoints(family.joints);
    if (!topic.text_arrays.empty() && !is_command) name_field_ = topic.text_arrays.front();
  }

  /// An array of numbers is named without index.
  static std::string FieldOf(const CatalogTopic& topic, const FieldFamily& family) {
    const std::string end = "[{i}]";
    if (topic.is_csv || !family.pattern.ends_with(end)) return family.pattern;
    return family.pattern.substr(0, family.pattern.size() - end.size());
  }

  static bool HasSentinel(const FieldFamily& family) {
    const auto& values = family.fields[0]->values;
    return !values.empty() && std::abs(values[0]) > 1e4;
  }

  static void CheckAngles(const FieldFamily& family, DraftSignal& signal) {
    double largest = 0.0;
    for (std::size_t k = 0; k < 12; ++k) {
      for (const double value : family.fields[k]->values) {
        if (std::abs(value) < 1e4) largest = std::max(largest, std::abs(value));
      }
    }
    if (largest <= 2.0 * std::numbers::pi) return;
    signal.options += ", unit: deg";
    signal.comment = fmt::format("up to {:.0f}: not rad", largest);
  }

  void OrderJoints(const std::vector<std::string>& names) {
    std::vector<std::string> full;
    for (const std::string& name : names) full.push_back("FL_" + name);
    const auto joints = JointsNamed(full);
    std::vector<std::string> ordered(3);
    for (std::size_t k = 0; k < 3; ++k) {
      if (joints[k]) ordered[static_cast<std::size_t>(joints[k]->joint)] = names[k];
    }
    if (std::find(ordered.begin(), ordered.end(), "") == ordered.end()) joints_ = ordered;
  }

  void AddFeet(const CatalogTopic& topic, const FieldFamily& family, const Words& words) {
    DraftSignal signal{"", topic.topic, Quoted(family.pattern), "", ""};
    const bool is_flag = std::all_of(family.fields.begin(), family.fields.end(), [](const auto* f) {
      return std::all_of(f->values.begin(), f->values.end(),
                         [](double v) { return v == 0.0 || v == 1.0; });
    });
    if (family.axes.size() == 3) {
      if (!HasAny(words, {"f", "force", "grf", "forces"})) return;
      signal.key = "force";
      signal.comment = "in the world's axes? else frame: body; axes of the feet cannot be mapped";
      Add("true_contacts", signal);
    } else if (is_flag && HasAny(words, {"contact", "contacts", "stance"})) {
      signal.key = "contact";
      signal.comment = "true, or as the robot estimates it? then the section is contacts";
      Add("true_contacts", signal);
    } else if (HasAny(words, {"foot", "force", "feet"}) && !HasAny(words, {"x", "y", "z"})) {
      signal.key = "force";
      signal.comment = "counts? check the order of the feet against the torques";
      Add("feet", signal);
    }
    if (family.legs.size() == 4 && legs_.empty()) legs_ = family.legs;
  }

  void AddVector(const CatalogTopic& topic, const FieldFamily& family, const Words& words) {
    const double norm = MeanNorm(family.fields);
    DraftSignal signal{"", topic.topic, Quoted(FieldOf(topic, family)), "", ""};
    if (family.fields.size() == 4) {
      if (std::abs(norm - 1.0) > 0.02 || SpreadOfNorm(family.fields) > 0.02) return;
      return AddAttitude(topic, family, signal);
    }
    if (family.fields.size() != 3) return;
    const bool is_letter = words.size() == 1 || (words.size() == 2 && words[0] == "imu");
    const std::string last = words.empty() ? "" : words.back();
    if (HasAny(words, {"acc", "accel", "acceleration", "accelerometer"}) ||
        (is_letter && last == "a")) {
      AddAcceleration(family, norm, signal);
    } else if (HasAny(words, {"gyro", "gyroscope", "omega"}) ||
               (HasAny(words, {"angular"}) && !HasAny(words, {"twist"})) ||
               (is_letter && last == "g")) {
      signal.key = "rate";
      Add("imu", signal);
    } else if (HasAny(words, {"p", "pos", "position", "trans", "base"})) {
      AddMotion(topic, "position", family, signal);
    } else if (HasAny(words, {"v", "vel", "velocity", "linear"}) && !IsImu(topic) &&
               !HasAny(words, {"angular"})) {
      signal.comment = "frame: body if it is in the trunk's axes; compare with the position";
      AddMotion(topic, "velocity", family, signal);
    } else if (HasAny(words, {"w"}) || HasAny(words, {"angular"})) {
      signal.comment = "frame: body if it is in the trunk's axes";
      AddMotion(topic, "rate", family, signal);
    }
  }

  static bool IsImu(const CatalogTopic& topic) {
    return HasAny(WordsOf(topic.type + " " + topic.topic), {"imu"});
  }

  /// Estimates of a robot's own messages, else truth.
  [[nodiscard]] static std::string MotionSection(const CatalogTopic& topic) {
    const Words words = WordsOf(topic.type + " " + topic.topic);
    const bool is_truth =
        topic.is_csv || HasAny(words, {"vicon", "mocap", "optitrack", "truth", "gt"});
    return is_truth ? "truth" : "estimate";
  }

  void AddMotion(const CatalogTopic& topic, const std::string& key, const FieldFamily& family,
                 DraftSignal signal) {
    const std::string section = MotionSection(topic);
    if (section == "estimate" && key == "rate") return;
    signal.key = key;
    if (key == "position") {
      double largest = 0.0;
      for (const CatalogField* field : family.fields) {
        for (const double value : field->values) largest = std::max(largest, std::abs(value));
      }
      if (largest > 100.0) signal.options = ", unit: mm";
      if (largest > 100.0) signal.comment = fmt::format("up to {:.0f}: not m", largest);
      if (topic.is_csv)
        signal.comment += signal.comment.empty() ? "truth? else the section is estimate" : "";
    }
    Add(section, signal);
  }

  void AddAcceleration(const FieldFamily& family, double norm, DraftSignal signal) {
    signal.key = "acceleration";
    const double z = MeanOf(family.fields[2]->values);
    if (norm > 0.8 && norm < 1.2) {
      signal.options = ", unit: g";
      signal.comment = "of length 1: g, not m/s2";
    } else if (norm < 7.0) {
      signal.options = ", gravity: removed";
      signal.comment = fmt::format("mean length {:.1f} m/s2: gravity is left out", norm);
    } else if (z < -7.0) {
      signal.options = ", axes: [-x, -y, -z]";
      signal.comment = fmt::format("z is {:.1f} m/s2 in the mean; or is only z flipped?", z);
    }
    Add("imu", signal);
  }

  void AddAttitude(const CatalogTopic& topic, const FieldFamily& family, DraftSignal signal) {
    signal.key = "attitude";
    if (family.axes.empty()) {
      const bool w_first =
          std::abs(MeanOf(family.fields[0]->values)) > std::abs(MeanOf(family.fields[3]->values));
      signal.options = w_first ? ", order: wxyz" : ", order: xyzw";
      signal.comment = "by its largest number";
    } else {
      signal.field = fmt::format("[{}]", fmt::join(AxisFields(family), ", "));
    }
    const bool is_robot = HasAny(WordsOf(family.pattern), {"imu"}) || IsImu(topic);
    const bool has_position =
        std::any_of(topic.fields.begin(), topic.fields.end(), [](const auto& f) {
          return HasAny(WordsOf(f.path), {"position", "px", "pos", "trans"});
        });
    Add(is_robot || !has_position ? "imu" : MotionSection(topic), signal);
  }

  /// x, y, z, w of a family of names.
  static std::vector<std::string> AxisFields(const FieldFamily& family) {
    std::vector<std::string> names;
    for (const char letter : {'x', 'y', 'z', 'w'}) {
      const auto at = family.pattern.find("{axis}");
      std::string name = family.pattern;
      names.push_back(Quoted(name.replace(at, 6, 1, letter)));
    }
    return names;
  }

  void AddNamedScalars(const CatalogTopic& topic) {
    std::map<std::string, std::string> by_name;
    for (const CatalogField& field : topic.fields) {
      const Words words = WordsOf(field.path);
      if (!words.empty()) by_name.try_emplace(fmt::format("{}", fmt::join(words, "_")), field.path);
    }
    const auto find = [&](std::initializer_list<const char*> names) -> std::string {
      for (const char* name : names) {
        if (by_name.contains(name)) return by_name.at(name);
      }
      return "";
    };
    if (const std::string v = find({"power_v", "voltage", "battery_voltage"}); !v.empty())
      Add("battery", {"voltage", topic.topic, Quoted(v), "", ""});
    if (const std::string a = find({"power_a", "current", "battery_current"}); !a.empty())
      Add("battery", {"current", topic.topic, Quoted(a), "", "drawn: positive?"});
    if (by_name.contains("roll") && by_name.contains("pitch") && by_name.contains("yaw")) {
      const bool has_position = !Section("truth").empty() || !Section("estimate").empty();
      Add(has_position ? MotionSection(topic) : "imu",
          {"attitude", topic.topic, "[roll, pitch, yaw]", ", form: rpy", ""});
    }
  }

  static double MeanOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
  }

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
    if (legs_.size() == 4) {
      text += fmt::format("legs: [{}]\n", fmt::join(legs_, ", "));
    } else if (const auto known = LegsOfKnownType(); !known.empty()) {
      text += fmt::format("legs: [{}]  # as robots with these messages have them\n",
                          fmt::join(known, ", "));
    } else if (name_field_.empty() && !Named("joints").empty()) {
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
    return std::find_if(sections_.begin(), sections_.end(),
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
      if (!used_topics_.contains(topic.topic)) {
        text += fmt::format("  # nothing recognised in {}\n", topic.topic);
        continue;
      }
      std::string name = AliasOf(topic.topic);
      const auto is_taken = [&](const auto& entry) { return entry.second == name; };
      while (std::any_of(aliases_.begin(), aliases_.end(), is_taken)) name += "_2";
      aliases_[topic.topic] = name;
      const std::string names = fmt::format("names: [{}]", Quoted(topic.topic));
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
    for (const auto& [name, signals] : sections_) {
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
    if (name == "joints" && !joints_.empty())
      text += fmt::format("  names: [{}]\n", fmt::join(joints_, ", "));
    if (name == "joints" && !name_field_.empty())
      text += fmt::format("  name_field: {}\n", name_field_);
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

  const std::vector<CatalogTopic>& topics_;
  const LogContents& contents_;
  Sections sections_;
  std::set<std::string> used_topics_;
  std::map<std::string, std::string> aliases_;
  std::vector<std::string> legs_, joints_;
  std::string name_field_;
};

}  // namespace

std::string DraftMapping(LogSource& log, const TypeResolver& resolver) {
  const std::vector<CatalogTopic> topics = CatalogFields(log, resolver);
  return Drafter(topics, log.contents()).Draft();
}

}  // namespace scoria::logs
