// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/archive.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text.h"

namespace scoria::core::config_detail {
namespace {

std::string Range(const FieldRule& rule) {
  return fmt::format("[{}, {}]", FormatDouble(rule.min), FormatDouble(rule.max));
}

const std::string& ScalarText(const ConfigNode& node, const std::string& path,
                              std::string_view expected) {
  if (node.kind != ConfigNode::Kind::kScalar) ThrowKind(node, path, expected);
  return node.scalar;
}

std::string ShownValue(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      return "an empty value";
    case ConfigNode::Kind::kScalar:
      return fmt::format("\"{}\"", Shown(node.scalar));
    case ConfigNode::Kind::kSequence:
      return "a list";
    case ConfigNode::Kind::kMap:
      return "a map";
  }
  return "";
}

void CheckRange(double value, const ConfigNode& node, const std::string& path,
                const FieldRule& rule) {
  if (!(value >= rule.min && value <= rule.max)) {
    throw ConfigError(node.origin, path,
                      fmt::format("{} is outside {}", Shown(node.scalar), Range(rule)));
  }
}

}  // namespace

bool ParseBool(const ConfigNode& node, const std::string& path) {
  const std::string& text = ScalarText(node, path, "true or false");
  if (text == "true") return true;
  if (text == "false") return false;
  ThrowKind(node, path, "true or false");
}

double ParseDouble(const ConfigNode& node, const std::string& path, const FieldRule& rule) {
  const std::string& text = ScalarText(node, path, "a number");
  double value = 0.0;
  if (text == ".inf") {
    value = std::numeric_limits<double>::infinity();
  } else {
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc{} || stop != end || std::isnan(value)) ThrowKind(node, path, "a number");
  }
  CheckRange(value, node, path, rule);
  return value;
}

std::int64_t ParseInt(const ConfigNode& node, const std::string& path, const FieldRule& rule) {
  const std::string& text = ScalarText(node, path, "a whole number");
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) ThrowKind(node, path, "a whole number");
  CheckRange(static_cast<double>(value), node, path, rule);
  return value;
}

std::uint64_t ParseUnsigned(const ConfigNode& node, const std::string& path) {
  const std::string& text = ScalarText(node, path, "a whole number from 0 on");
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) ThrowKind(node, path, "a whole number from 0 on");
  return value;
}

std::string ParseString(const ConfigNode& node, const std::string& path) {
  return ScalarText(node, path, "a text");
}

void ThrowUnknownChoice(const ConfigNode& node, const std::string& path,
                        std::vector<std::string> choices) {
  std::sort(choices.begin(), choices.end());
  throw ConfigError(node.origin, path,
                    fmt::format("unknown {}; choices: {}{}", ShownValue(node),
                                fmt::join(choices, ", "), DidYouMean(node.scalar, choices)));
}

void ThrowKind(const ConfigNode& node, const std::string& path, std::string_view expected) {
  throw ConfigError(node.origin, path, fmt::format("{} is not {}", ShownValue(node), expected));
}

void ThrowLength(const ConfigNode& node, const std::string& path, std::size_t want) {
  throw ConfigError(node.origin, path,
                    fmt::format("has {} elements, must have {}", node.items.size(), want));
}

void ThrowUnknownKey(const ConfigNode::Entry& entry, const std::string& path,
                     const std::vector<std::string>& known) {
  std::string hint = DidYouMean(entry.key, known);
  if (hint.empty()) hint = fmt::format("; known here: {}", fmt::join(known, ", "));
  throw ConfigError(entry.key_origin, path, "unknown key" + hint);
}

void ThrowTwice(const ConfigNode& former, const std::string& path, const char* was) {
  throw ConfigError(former.origin, path, fmt::format("is given as {}, its former name, too", was));
}

void AddNote(const ConfigNode& node, const std::string& what, std::vector<std::string>& notes) {
  notes.push_back(fmt::format("{}: {}", node.origin.ToString(), what));
}

std::string FormatDouble(double value) {
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return fmt::format("{}", value);
}

ConfigNode Scalar(std::string text) {
  return {ConfigNode::Kind::kScalar, std::move(text), {}, {}, {}};
}

ConfigNode LongForm(const ConfigNode& node, const char* scalar_key, const char* list_key) {
  const bool is_scalar = node.kind == ConfigNode::Kind::kScalar;
  if (!is_scalar && node.kind != ConfigNode::Kind::kSequence) return node;
  ConfigNode map{ConfigNode::Kind::kMap, {}, {}, {}, node.origin};
  map.entries.push_back({is_scalar ? scalar_key : list_key, node.origin, node});
  return map;
}

}  // namespace scoria::core::config_detail
