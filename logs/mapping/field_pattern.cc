// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/field_pattern.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

/// A way in which a signal has several numbers.
struct Extent {
  std::string_view placeholder;
  std::vector<std::string> names;
};

std::vector<Extent> ExtentsOf(SignalShape shape, std::size_t size, const PatternNames& names) {
  const Extent legs{"leg", {names.legs.begin(), names.legs.end()}};
  const Extent joints{"joint", {names.joints.begin(), names.joints.end()}};
  Extent axes{"axis", {}};
  for (const char letter : names.axes.substr(0, size)) axes.names.emplace_back(1, letter);
  switch (shape) {
    case SignalShape::kScalar:
      return {};
    case SignalShape::kVector:
    case SignalShape::kAttitude:
      return {axes};
    case SignalShape::kPerLeg:
      return {legs};
    case SignalShape::kPerJoint:
      return names.by_joint ? std::vector{joints, legs} : std::vector{legs, joints};
    case SignalShape::kVectorPerLeg:
      return {legs, axes};
  }
  return {};
}

/// A pattern in parts: texts, and placeholders between them.
struct PatternPart {
  std::string text;  // of a text, or of a placeholder the name
  bool is_placeholder = false;
  std::size_t first = 0;  // of {i+first}
};

PatternPart ParsePlaceholder(std::string_view inside, const std::vector<Extent>& extents) {
  PatternPart part{std::string(inside), true, 0};
  if (inside.starts_with("i+")) {
    const char* end = inside.data() + inside.size();
    const auto [stop, error] = std::from_chars(inside.data() + 2, end, part.first);
    if (error == std::errc() && stop == end) part.text = "i";
  }
  std::vector<std::string> choices;
  for (const Extent& extent : extents) choices.push_back(fmt::format("{{{}}}", extent.placeholder));
  choices.emplace_back("{i}");
  if (part.text == "i" || std::any_of(extents.begin(), extents.end(), [&](const Extent& extent) {
        return extent.placeholder == part.text;
      }))
    return part;
  throw PatternError(
      fmt::format("{{{}}} is no placeholder here; choices: {}", inside, fmt::join(choices, ", ")));
}

std::vector<PatternPart> ParseParts(std::string_view pattern, const std::vector<Extent>& extents) {
  std::vector<PatternPart> parts;
  while (!pattern.empty()) {
    const std::size_t open = std::min(pattern.find('{'), pattern.size());
    if (open > 0) parts.push_back({std::string(pattern.substr(0, open)), false, 0});
    pattern.remove_prefix(open);
    if (pattern.empty()) break;
    const std::size_t close = pattern.find('}');
    if (close == std::string_view::npos) throw PatternError("a { has no }");
    parts.push_back(ParsePlaceholder(pattern.substr(1, close - 1), extents));
    pattern.remove_prefix(close + 1);
  }
  return parts;
}

bool HasPlaceholder(const std::vector<PatternPart>& parts, std::string_view placeholder) {
  return std::any_of(parts.begin(), parts.end(), [&](const PatternPart& part) {
    return part.is_placeholder && part.text == placeholder;
  });
}

}  // namespace

ExpandedPattern ExpandPattern(const std::string& pattern, SignalShape shape, std::size_t size,
                              const PatternNames& names) {
  const std::vector<Extent> extents = ExtentsOf(shape, size, names);
  const std::vector<PatternPart> parts = ParseParts(pattern, extents);
  const bool counts = HasPlaceholder(parts, "i");
  ExpandedPattern out;
  std::vector<std::size_t> free;  // extents without a placeholder
  std::size_t total = 1;
  for (std::size_t d = 0; d < extents.size(); ++d) {
    total *= extents[d].names.size();
    if (!HasPlaceholder(parts, extents[d].placeholder)) free.push_back(d);
  }
  if (!counts) {
    for (const std::size_t d : free) out.elements *= extents[d].names.size();
    out.is_vector = free.size() == 1 && extents[free[0]].placeholder == "axis";
  }
  for (std::size_t flat = 0; flat < total; ++flat) {
    std::vector<std::size_t> index(extents.size());
    for (std::size_t d = extents.size(), rest = flat; d-- > 0; rest /= extents[d].names.size())
      index[d] = rest % extents[d].names.size();
    std::size_t number = 0;
    for (const std::size_t d : free) number = number * extents[d].names.size() + index[d];
    PatternPlace place;
    for (const PatternPart& part : parts) {
      if (!part.is_placeholder) place.path += part.text;
      if (part.is_placeholder && part.text == "i")
        place.path += fmt::to_string(number + part.first);
      for (std::size_t d = 0; d < extents.size(); ++d) {
        if (part.is_placeholder && part.text == extents[d].placeholder)
          place.path += extents[d].names[index[d]];
      }
    }
    place.element = counts ? 0 : number;
    out.places.push_back(std::move(place));
  }
  return out;
}

}  // namespace scoria::logs
