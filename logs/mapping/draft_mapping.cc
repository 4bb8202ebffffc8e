// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/draft_mapping.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "logs/mapping/draft_numbers.h"
#include "logs/mapping/draft_text.h"
#include "logs/mapping/field_catalog.h"
#include "logs/mapping/vocabulary.h"

namespace scoria::logs {
namespace {

using Words = std::vector<std::string>;

class Drafter {
 public:
  explicit Drafter(const std::vector<CatalogTopic>& topics) : topics_(topics) {
    for (const char* name : {"joints", "imu", "feet", "battery", "joint_command", "estimate",
                             "truth", "true_contacts", "contacts", "command"})
      content_.sections.emplace_back(name, std::vector<DraftSignal>());
  }

  DraftContent Collect() {
    for (const CatalogTopic& topic : topics_) {
      if (topic.is_csv && !topic.has_names) {
        for (const NumberGuess& guess : GuessByNumbers(topic)) AddGuess(topic, guess);
        continue;
      }
      for (const FieldFamily& family : FindFamilies(topic)) AddFamily(topic, family);
      AddNamedScalars(topic);
    }
    return std::move(content_);
  }

 private:
  std::vector<DraftSignal>& Section(const std::string& name) {
    return std::find_if(content_.sections.begin(), content_.sections.end(),
                        [&](const auto& section) { return section.first == name; })
        ->second;
  }

  /// The first field that is found for a signal is taken.
  bool Add(const std::string& section, DraftSignal signal) {
    std::vector<DraftSignal>& signals = Section(section);
    const bool is_known = std::any_of(signals.begin(), signals.end(),
                                      [&](const DraftSignal& s) { return s.key == signal.key; });
    if (is_known) return false;
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
    signal.field = QuotedInYaml(FieldOf(topic, family));
    if (key == "q") CheckAngles(family, signal);
    if (is_command && HasSentinel(family))
      signal.options += fmt::format(", absent: [{:g}]", family.fields[0]->values[0]);
    const bool is_gain = key == "kp" || key == "kd";
    if (is_gain && !is_command) return;
    if (!Add(is_command ? "joint_command" : "joints", signal)) return;
    if (family.legs.size() == 4) content_.legs = family.legs;
    if (family.joints.size() == 3) OrderJoints(family.joints);
    if (!topic.text_arrays.empty() && !is_command) content_.name_field = topic.text_arrays.front();
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
    if (std::find(ordered.begin(), ordered.end(), "") == ordered.end()) content_.joints = ordered;
  }

  void AddFeet(const CatalogTopic& topic, const FieldFamily& family, const Words& words) {
    DraftSignal signal{"", topic.topic, QuotedInYaml(family.pattern), "", ""};
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
    if (family.legs.size() == 4 && content_.legs.empty()) content_.legs = family.legs;
  }

  void AddVector(const CatalogTopic& topic, const FieldFamily& family, const Words& words) {
    const double norm = MeanNorm(family.fields);
    DraftSignal signal{"", topic.topic, QuotedInYaml(FieldOf(topic, family)), "", ""};
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
      names.push_back(QuotedInYaml(name.replace(at, 6, 1, letter)));
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
      Add("battery", {"voltage", topic.topic, QuotedInYaml(v), "", ""});
    if (const std::string a = find({"power_a", "current", "battery_current"}); !a.empty())
      Add("battery", {"current", topic.topic, QuotedInYaml(a), "", "drawn: positive?"});
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

  const std::vector<CatalogTopic>& topics_;
  DraftContent content_;
};

}  // namespace

std::string DraftMapping(LogSource& log, const TypeResolver& resolver) {
  const std::vector<CatalogTopic> topics = CatalogFields(log, resolver);
  return DraftText(topics, log.contents(), Drafter(topics).Collect());
}

}  // namespace scoria::logs
