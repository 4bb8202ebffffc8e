// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/config/field.h"
#include "core/config/node.h"
#include "core/config/scale.h"
#include "core/math/types.h"

/// Reading (ReadConfig), writing (WriteConfig) and documentation (DescribeConfig) of structs that
/// say once what they hold (see field.h). A ConfigNode takes any value as it stands, a ConfigMap
/// any map.
namespace scoria::core {

/// What DescribeConfig tells of one field.
struct FieldInfo {
  std::string key, kind, default_value, doc;
  std::string scale;  // how the default goes with the robot (ScaleText)
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool required = false;
  bool has_short_form = false;       // may be a string, or a list of strings, for one of its keys
  std::vector<std::string> choices;  // of an enum
  std::vector<FieldInfo>
      children;  // of a struct; of a variant one per alternative; of a list or map its element
};

/// A map that is read elsewhere, as overrides of another file's keys.
struct ConfigMap {
  ConfigNode node;
};

namespace config_detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... Ts>
struct IsVariant<std::variant<Ts...>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};

template <class T>
struct IsMap : std::false_type {};
template <class T>
struct IsMap<std::map<std::string, T>> : std::true_type {};

template <class T>
std::vector<std::string> Choices() {
  std::vector<std::string> names;
  for (const auto& [v, name] : EnumNames(T{})) names.emplace_back(name);
  return names;
}

template <class... Ts>
std::vector<std::string> TypeNames(const std::variant<Ts...>*) {
  return {Ts::kType...};
}

/// Whether a variant's `type` of this name means T.
template <class T>
bool IsTypeOf(std::string_view name) {
  if constexpr (requires { T::kFormerType; }) {
    if (name == T::kFormerType) return true;
  }
  return name == T::kType;
}

bool ParseBool(const ConfigNode& node, const std::string& path);
double ParseDouble(const ConfigNode& node, const std::string& path, const FieldRule& rule);
std::int64_t ParseInt(const ConfigNode& node, const std::string& path, const FieldRule& rule);
std::uint64_t ParseUnsigned(const ConfigNode& node, const std::string& path);
std::string ParseString(const ConfigNode& node, const std::string& path);
[[noreturn]] void ThrowUnknownChoice(const ConfigNode& node, const std::string& path,
                                     std::vector<std::string> choices);
[[noreturn]] void ThrowKind(const ConfigNode& node, const std::string& path,
                            std::string_view expected);
[[noreturn]] void ThrowLength(const ConfigNode& node, const std::string& path, std::size_t want);
[[noreturn]] void ThrowUnknownKey(const ConfigNode::Entry& entry, const std::string& path,
                                  const std::vector<std::string>& known);
void AddNote(const ConfigNode& node, const std::string& what, std::vector<std::string>& notes);
[[noreturn]] void ThrowTwice(const ConfigNode& former, const std::string& path, const char* was);
std::string FormatDouble(double value);
ConfigNode Scalar(std::string text);
/// A struct that was written short, as one value or a list, with the key that this stands for.
ConfigNode LongForm(const ConfigNode& node, const char* scalar_key, const char* list_key);

}  // namespace config_detail

/// What reading says besides the value, a sentence each: names that are now others.
using ConfigNotes = std::vector<std::string>;

/// What reading goes by, and what it says.
struct ConfigContext {
  Similarity similarity;  // scales the defaults of what the text does not give
  ConfigNotes notes;
};

/// Reads one map strictly: after Serialize, every key of the map must have been asked for.
class ConfigReader {
 public:
  ConfigReader(const ConfigNode& node, std::string path, ConfigContext& context)
      : node_(node), path_(std::move(path)), context_(context) {
    if (node.kind != ConfigNode::Kind::kMap && node.kind != ConfigNode::Kind::kNull) {
      config_detail::ThrowKind(node, path_, "a map");
    }
  }

  /// A missing key keeps the default that `value` holds.
  template <class T>
  void Field(const char* key, T& value, const FieldRule& rule = {}) {
    known_.emplace_back(key);
    const ConfigNode* child = node_.Find(key);
    if (const ConfigNode* former = rule.was != nullptr ? node_.Find(rule.was) : nullptr) {
      if (child != nullptr) config_detail::ThrowTwice(*former, PathOf(key), rule.was);
      ReadFormer(*former, key, value, rule);
    } else if (child != nullptr) {
      Read(*child, PathOf(key), context_, value, rule);
    } else if (!context_.similarity.IsReference()) {
      ConfigScaler(context_.similarity).Scale(value, rule);
    }
  }

  template <class T>
  void Required(const char* key, T& value, const FieldRule& rule = {}) {
    if (node_.Find(key) == nullptr && (rule.was == nullptr || node_.Find(rule.was) == nullptr)) {
      throw ConfigError(node_.origin, PathOf(key), "is missing and has no default");
    }
    Field(key, value, rule);
  }

  void Finish() const {
    for (const ConfigNode::Entry& entry : node_.entries) {
      if (std::ranges::find(known_, entry.key) == known_.end() &&
          std::ranges::find(former_, entry.key) == former_.end()) {
        config_detail::ThrowUnknownKey(entry, PathOf(entry.key), known_);
      }
    }
  }

  template <class T>
  static void Read(const ConfigNode& node, const std::string& path, ConfigContext& context,
                   T& value, const FieldRule& rule = {});

 private:
  [[nodiscard]] std::string PathOf(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
  }
  /// A struct whose fields depend on each other says what is wrong with them in Problem(), empty if
  /// nothing.
  template <class T>
  static void CheckWhole(const ConfigNode& node, const std::string& path, const T& value) {
    if constexpr (requires { value.Problem(); }) {
      const std::string problem = value.Problem();
      if (!problem.empty()) throw ConfigError(node.origin, path, problem);
    }
  }
  template <class T>
  void ReadFormer(const ConfigNode& former, const char* key, T& value, FieldRule rule) {
    former_.emplace_back(rule.was);
    if constexpr (std::is_same_v<T, double>) {
      if (rule.from_was != nullptr) rule.min = -(rule.max = FieldRule{}.max);
    }
    Read(former, PathOf(rule.was), context_, value, rule);
    std::string note = fmt::format("{} is now {}", PathOf(rule.was), key);
    if constexpr (std::is_same_v<T, double>) {
      if (rule.from_was != nullptr) {
        value = rule.from_was(value);
        note += fmt::format(", here {}", config_detail::FormatDouble(value));
      }
    }
    config_detail::AddNote(former, note, context_.notes);
  }
  template <class T>
  static void ReadStruct(const ConfigNode& node, const std::string& path, ConfigContext& context,
                         T& value) {
    ConfigReader reader(node, path, context);
    value.Serialize(reader);
    reader.Finish();
    CheckWhole(node, path, value);
  }
  template <class Variant>
  static void ReadVariant(const ConfigNode& node, const std::string& path, ConfigContext& context,
                          Variant& value);
  template <class Enum>
  static void ReadEnum(const ConfigNode& node, const std::string& path, ConfigContext& context,
                       Enum& value);

  const ConfigNode& node_;
  std::string path_;
  ConfigContext& context_;
  std::vector<std::string> known_, former_;
};

template <class Enum>
void ConfigReader::ReadEnum(const ConfigNode& node, const std::string& path, ConfigContext& context,
                            Enum& value) {
  const std::string name = config_detail::ParseString(node, path);
  for (const auto& [v, n] : EnumNames(Enum{})) {
    if (n != name) continue;
    value = v;
    return;
  }
  if constexpr (requires { FormerNames(Enum{}); }) {
    for (const auto& [v, n] : FormerNames(Enum{})) {
      if (n != name) continue;
      value = v;
      config_detail::AddNote(node, fmt::format("{}: {} is now {}", path, n, EnumName(v)),
                             context.notes);
      return;
    }
  }
  config_detail::ThrowUnknownChoice(node, path, config_detail::Choices<Enum>());
}

template <class Variant>
void ConfigReader::ReadVariant(const ConfigNode& node, const std::string& path,
                               ConfigContext& context, Variant& value) {
  if (node.kind != ConfigNode::Kind::kMap)
    config_detail::ThrowKind(node, path, "a map with a type");
  // Without a type it is the default's.
  const ConfigNode* type = node.Find("type");
  const std::string name =
      type != nullptr ? type->scalar : config_detail::TypeNames(&value)[value.index()];
  bool found = false;
  auto try_alternative = [&]<class T>(std::type_identity<T>) {
    if (found || !config_detail::IsTypeOf<T>(name)) return;
    found = true;
    if (name != T::kType)
      config_detail::AddNote(*type, fmt::format("{}.type: {} is now {}", path, name, T::kType),
                             context.notes);
    T alternative = std::holds_alternative<T>(value) ? std::get<T>(value) : T{};
    ConfigReader reader(node, path, context);
    reader.known_.emplace_back("type");
    alternative.Serialize(reader);
    reader.Finish();
    CheckWhole(node, path, alternative);
    value = std::move(alternative);
  };
  [&]<class... Ts>(const std::variant<Ts...>*) {
    (try_alternative(std::type_identity<Ts>{}), ...);
  }(&value);
  if (!found)
    config_detail::ThrowUnknownChoice(*type, path + ".type", config_detail::TypeNames(&value));
}

template <class T>
void ConfigReader::Read(const ConfigNode& node, const std::string& path, ConfigContext& context,
                        T& value, const FieldRule& rule) {
  namespace d = config_detail;
  if constexpr (std::is_same_v<T, bool>) {
    value = d::ParseBool(node, path);
  } else if constexpr (std::is_unsigned_v<T>) {
    value = d::ParseUnsigned(node, path);
  } else if constexpr (std::is_integral_v<T>) {
    value = static_cast<T>(d::ParseInt(node, path, rule));
  } else if constexpr (std::is_floating_point_v<T>) {
    value = d::ParseDouble(node, path, rule);
  } else if constexpr (std::is_same_v<T, ConfigNode>) {
    value = node;
  } else if constexpr (std::is_same_v<T, ConfigMap>) {
    if (node.kind != ConfigNode::Kind::kMap) d::ThrowKind(node, path, "a map");
    value.node = node;
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = d::ParseString(node, path);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    const std::filesystem::path given = d::ParseString(node, path);
    value = given.empty() ? given : (node.origin.Folder() / given).lexically_normal();
  } else if constexpr (NamedEnum<T>) {
    ReadEnum(node, path, context, value);
  } else if constexpr (d::IsOptional<T>::value) {
    if (node.kind == ConfigNode::Kind::kNull) {
      value.reset();
    } else {
      Read(node, path, context, value.emplace(), rule);
    }
  } else if constexpr (d::IsVector<T>::value) {
    if (node.kind != ConfigNode::Kind::kSequence) d::ThrowKind(node, path, "a list");
    value.clear();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      Read(node.items[i], fmt::format("{}[{}]", path, i), context, value.emplace_back(), rule);
    }
  } else if constexpr (d::IsArray<T>::value || std::is_same_v<T, Vec3>) {
    if (node.kind != ConfigNode::Kind::kSequence) d::ThrowKind(node, path, "a list");
    const std::size_t n = static_cast<std::size_t>(value.size());
    if (node.items.size() != n) d::ThrowLength(node, path, n);
    for (std::size_t i = 0; i < n; ++i) {
      Read(node.items[i], fmt::format("{}[{}]", path, i), context, value[i], rule);
    }
  } else if constexpr (d::IsVariant<T>::value) {
    ReadVariant(node, path, context, value);
  } else if constexpr (d::IsMap<T>::value) {
    if (node.kind != ConfigNode::Kind::kMap) d::ThrowKind(node, path, "a map");
    for (const ConfigNode::Entry& entry : node.entries)
      Read(entry.value, path + "." + entry.key, context, value[entry.key], rule);
  } else if constexpr (requires { T::kScalarKey; }) {
    ReadStruct(d::LongForm(node, T::kScalarKey, T::kListKey), path, context, value);
  } else {
    ReadStruct(node, path, context, value);
  }
}

/// Builds the tree that ReadConfig would read back to an equal value.
class ConfigWriter {
 public:
  template <class T>
  void Field(const char* key, T& value, const FieldRule& = {}) {
    node_.entries.push_back({key, {}, Write(value)});
  }
  template <class T>
  void Required(const char* key, T& value, const FieldRule& = {}) {
    Field(key, value);
  }

  template <class T>
  [[nodiscard]] static ConfigNode Write(T& value);

 private:
  ConfigNode node_{ConfigNode::Kind::kMap, {}, {}, {}, {}};
};

template <class T>
ConfigNode ConfigWriter::Write(T& value) {
  namespace d = config_detail;
  if constexpr (std::is_same_v<T, bool>) {
    return d::Scalar(value ? "true" : "false");
  } else if constexpr (std::is_integral_v<T>) {
    return d::Scalar(fmt::to_string(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return d::Scalar(d::FormatDouble(value));
  } else if constexpr (std::is_same_v<T, ConfigNode>) {
    return value;
  } else if constexpr (std::is_same_v<T, ConfigMap>) {
    return value.node;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return d::Scalar(value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return d::Scalar(value.empty() ? "" : std::filesystem::absolute(value).string());
  } else if constexpr (NamedEnum<T>) {
    return d::Scalar(std::string(EnumName(value)));
  } else if constexpr (d::IsOptional<T>::value) {
    return value ? Write(*value) : ConfigNode{};
  } else if constexpr (d::IsVector<T>::value || d::IsArray<T>::value || std::is_same_v<T, Vec3>) {
    ConfigNode list{ConfigNode::Kind::kSequence, {}, {}, {}, {}};
    for (auto& item : value) list.items.push_back(Write(item));
    return list;
  } else if constexpr (d::IsMap<T>::value) {
    ConfigNode map{ConfigNode::Kind::kMap, {}, {}, {}, {}};
    for (auto& [key, item] : value) map.entries.push_back({key, {}, Write(item)});
    return map;
  } else if constexpr (d::IsVariant<T>::value) {
    return std::visit(
        [](auto& alternative) {
          ConfigWriter writer;
          writer.node_.entries.push_back({"type", {}, d::Scalar(alternative.kType)});
          alternative.Serialize(writer);
          return std::move(writer.node_);
        },
        value);
  } else {
    ConfigWriter writer;
    value.Serialize(writer);
    return std::move(writer.node_);
  }
}

/// Lists keys, kinds, defaults, ranges and notes of a struct, for documentation and schemas.
class ConfigDescriber {
 public:
  template <class T>
  void Field(const char* key, T& value, const FieldRule& rule = {}) {
    FieldInfo info = Describe(value);
    info.key = key;
    info.doc = rule.doc;
    info.scale = ScaleText(rule.scale);
    info.min = rule.min;
    info.max = rule.max;
    fields_.push_back(std::move(info));
  }
  template <class T>
  void Required(const char* key, T& value, const FieldRule& rule = {}) {
    Field(key, value, rule);
    fields_.back().required = true;
  }
  [[nodiscard]] const std::vector<FieldInfo>& fields() const { return fields_; }

  template <class T>
  [[nodiscard]] static FieldInfo Describe(T& value);

 private:
  template <class... Ts>
  static std::vector<FieldInfo> DescribeAlternatives(const std::variant<Ts...>*);

  std::vector<FieldInfo> fields_;
};

template <class... Ts>
std::vector<FieldInfo> ConfigDescriber::DescribeAlternatives(const std::variant<Ts...>*) {
  std::vector<FieldInfo> children;
  const auto add = [&]<class A>(std::type_identity<A>) {
    A alternative{};
    FieldInfo child = Describe(alternative);
    child.key = A::kType;
    children.push_back(std::move(child));
  };
  (add(std::type_identity<Ts>{}), ...);
  return children;
}

template <class T>
FieldInfo ConfigDescriber::Describe(T& value) {
  namespace d = config_detail;
  FieldInfo info;
  if constexpr (std::is_same_v<T, ConfigNode> || std::is_same_v<T, ConfigMap>) {
    info.kind = std::is_same_v<T, ConfigNode> ? "any" : "map";
    return info;
  } else if constexpr (std::is_same_v<T, bool>) {
    info.kind = "bool";
  } else if constexpr (std::is_integral_v<T>) {
    info.kind = "integer";
  } else if constexpr (std::is_floating_point_v<T>) {
    info.kind = "number";
  } else if constexpr (std::is_same_v<T, std::string>) {
    info.kind = "string";
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    info.kind = "path";
  } else if constexpr (NamedEnum<T>) {
    info.kind = "choice";
    info.choices = d::Choices<T>();
  } else if constexpr (d::IsOptional<T>::value) {
    typename T::value_type element{};
    info = Describe(element);
    info.default_value = "";
    return info;
  } else if constexpr (d::IsVector<T>::value) {
    typename T::value_type element{};
    info.kind = "list";
    info.children.push_back(Describe(element));
  } else if constexpr (d::IsMap<T>::value) {
    typename T::mapped_type element{};
    info.kind = "map by name";
    info.children.push_back(Describe(element));
    return info;
  } else if constexpr (d::IsArray<T>::value || std::is_same_v<T, Vec3>) {
    using Element = std::decay_t<decltype(value[0])>;
    constexpr bool kNumbers = std::is_arithmetic_v<Element>;
    info.kind = fmt::format("list of {} {}", value.size(), kNumbers ? "numbers" : "strings");
  } else if constexpr (d::IsVariant<T>::value) {
    info.kind = "variant";
    info.default_value = std::visit([](auto& a) { return std::string(a.kType); }, value);
    info.children = DescribeAlternatives(&value);
    return info;
  } else {
    ConfigDescriber describer;
    value.Serialize(describer);
    info.kind = "struct";
    info.has_short_form = requires { T::kScalarKey; };
    info.children = describer.fields_;
    return info;
  }
  const ConfigNode node = ConfigWriter::Write(value);
  std::string text = node.kind == ConfigNode::Kind::kScalar ? node.scalar : EmitYaml(node);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  info.default_value = text;
  return info;
}

/// @returns T with defaults overridden by `node`.
/// Errors: ConfigError naming file, line, column, key, value and what is allowed.
template <class T>
[[nodiscard]] T ReadConfig(const ConfigNode& node, ConfigContext& context) {
  T value{};
  ConfigReader::Read(node, "", context, value);
  return value;
}
template <class T>
[[nodiscard]] T ReadConfig(const ConfigNode& node) {
  ConfigContext context;
  return ReadConfig<T>(node, context);
}

template <class T>
[[nodiscard]] ConfigNode WriteConfig(T value) {
  return ConfigWriter::Write(value);
}

template <class T>
[[nodiscard]] FieldInfo DescribeConfig() {
  T value{};
  return ConfigDescriber::Describe(value);
}

}  // namespace scoria::core
