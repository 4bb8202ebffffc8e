// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/field_path.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/names.h"

namespace scoria::logs {
namespace {

struct PathPart {
  std::string name;
  std::optional<std::uint64_t> element;
};

std::string Quoted(std::string_view text) { return fmt::format("\"{}\"", core::Shown(text)); }

class PathResolver {
 public:
  PathResolver(const MessageType& type, std::string_view path) : type_(type), path_(path) {}

  ResolvedField Resolve() {
    ResolvedField field;
    field.path = path_;
    const StructLayout* layout = &type_.root();
    std::string_view rest = path_;
    for (;;) {
      const std::size_t dot = rest.find('.');
      const bool is_last = dot == std::string_view::npos;
      const PathPart part = ParsePart(rest.substr(0, dot));
      const std::size_t index = IndexOf(*layout, part.name);
      const Member& member = layout->members[index];
      CheckElement(member, part);
      field.steps.push_back({index, part.element});
      if (is_last) return WithEnd(std::move(field), member, part);
      CheckInner(member, part);
      layout = &type_.StructOf(member);
      rest.remove_prefix(dot + 1);
    }
  }

 private:
  [[noreturn]] void Fail(const std::string& rule) const {
    throw FieldPathError(fmt::format("{}: {}", core::Shown(path_, 200), rule));
  }

  [[nodiscard]] PathPart ParsePart(std::string_view text) const {
    const std::size_t open = text.find('[');
    PathPart part{std::string(text.substr(0, open)), std::nullopt};
    if (!IsName(part.name)) Fail(Quoted(part.name) + " is not the name of a field");
    if (open == std::string_view::npos) return part;
    const std::string_view inside = text.substr(open + 1);
    const std::string_view digits = inside.substr(0, inside.find(']'));
    std::uint64_t element = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), element);
    if (error != std::errc() || end != digits.data() + digits.size() ||
        inside.size() != digits.size() + 1) {
      Fail(Quoted(text.substr(open)) + " is not an element, such as [0]");
    }
    part.element = element;
    return part;
  }

  [[nodiscard]] std::size_t IndexOf(const StructLayout& layout, const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < layout.members.size(); ++i) {
      if (layout.members[i].is_filler) continue;
      if (layout.members[i].name == name) return i;
      names.push_back(layout.members[i].name);
    }
    Fail(fmt::format("{} has no field {}{}", layout.name, Quoted(name),
                     core::DidYouMean(name, names)));
  }

  void CheckElement(const Member& member, const PathPart& part) const {
    if (!part.element) return;
    if (member.multiplicity == Multiplicity::kOne) {
      Fail(fmt::format("{} is one {}, not an array", member.name, DescribeType(type_, member)));
    }
    const bool is_bounded = member.multiplicity == Multiplicity::kArray || member.count > 0;
    if (is_bounded && *part.element >= member.count) {
      Fail(fmt::format("{} is {}: elements 0 to {}", member.name, DescribeType(type_, member),
                       member.count - 1));
    }
  }

  /// Of a part that another follows.
  void CheckInner(const Member& member, const PathPart& part) const {
    if (member.type != FieldType::kStruct) {
      Fail(fmt::format("{} is {} and has no fields", member.name, DescribeType(type_, member)));
    }
    if (member.multiplicity != Multiplicity::kOne && !part.element) {
      Fail(fmt::format("{0} is {1}: one element is needed, such as {0}[0]", member.name,
                       DescribeType(type_, member)));
    }
  }

  [[nodiscard]] ResolvedField WithEnd(ResolvedField field, const Member& member,
                                      const PathPart& part) const {
    field.type = member.type;
    field.multiplicity = part.element ? Multiplicity::kOne : member.multiplicity;
    field.count = part.element ? 1 : member.count;
    if (member.type != FieldType::kStruct) return field;
    const StructLayout& layout = type_.StructOf(member);
    if (layout.is_time && field.multiplicity == Multiplicity::kOne) {
      field.type = FieldType::kTime;
      return field;
    }
    std::vector<std::string> names;
    for (const Member& inner : layout.members) {
      if (!inner.is_filler) names.push_back(inner.name);
    }
    std::sort(names.begin(), names.end());
    Fail(fmt::format("{} is {}, whose fields are: {}", member.name, DescribeType(type_, member),
                     fmt::join(names, ", ")));
  }

  const MessageType& type_;
  std::string_view path_;
};

}  // namespace

ResolvedField ResolveField(const MessageType& type, std::string_view path) {
  return PathResolver(type, path).Resolve();
}

}  // namespace scoria::logs
