// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/message_type.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/text.h"

namespace scoria::logs {
namespace {

/// More than any message holds; sums and products of sizes stop here.
constexpr std::uint64_t kTooLarge = std::uint64_t{1} << 40;

std::uint64_t CappedSum(std::uint64_t a, std::uint64_t b) { return std::min(a + b, kTooLarge); }

/// @pre both at most kTooLarge.
std::uint64_t CappedProduct(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kTooLarge / b ? kTooLarge : a * b;
}

FixedExtent Joined(const FixedExtent& first, const FixedExtent& second) noexcept {
  FixedExtent both;
  for (std::size_t at = 0; at < both.size(); ++at) {
    both[at] = CappedSum(first[at], second[(at + first[at]) % 8]);
  }
  return both;
}

/// The bytes of `count` times `one`, each after the other.
FixedExtent Repeated(const FixedExtent& one, std::uint64_t count) noexcept {
  FixedExtent result{};
  FixedExtent power = one;
  for (; count > 0; count /= 2) {
    if (count % 2 == 1) result = Joined(result, power);
    power = Joined(power, power);
  }
  return result;
}

FixedExtent NumbersExtent(std::size_t size, std::uint64_t count, CdrVersion version) {
  const std::size_t alignment =
      version == CdrVersion::kXcdr2 ? std::min<std::size_t>(size, 4) : size;
  FixedExtent extent;
  for (std::size_t at = 0; at < extent.size(); ++at) {
    const std::size_t padding = (alignment - at % alignment) % alignment;
    extent[at] = CappedSum(padding, CappedProduct(size, count));
  }
  return extent;
}

bool IsTimeLayout(const std::vector<Member>& members) {
  const auto is = [&](std::size_t i, std::string_view name, FieldType type) {
    return members[i].name == name && members[i].type == type &&
           members[i].multiplicity == Multiplicity::kOne;
  };
  return members.size() == 2 && is(0, "sec", FieldType::kInt32) &&
         is(1, "nanosec", FieldType::kUint32);
}

/// Builds the table of structs, each with what can be known of its size.
class TypeBuilder {
 public:
  explicit TypeBuilder(const FindDefinition& find) : find_(find) {}

  std::vector<StructLayout> Build(const MessageDefinition& root) {
    Add(root, 1);
    return std::move(structs_);
  }

 private:
  struct Facts {
    int height = 0;  // 0 while it is being built
    std::uint64_t leaves = 0;
  };

  std::uint32_t Add(const MessageDefinition& definition, int depth) {
    if (depth > MessageType::kDeepest) FailDepth(definition.name);
    const auto index = static_cast<std::uint32_t>(structs_.size());
    index_[definition.name] = index;
    structs_.emplace_back();
    facts_.emplace_back();
    StructLayout layout;
    layout.name = definition.name;
    layout.extensibility = definition.extensibility;
    Facts facts{1, 0};
    for (const FieldDefinition& field : definition.fields) {
      layout.members.push_back(MemberOf(field, definition, depth));
      facts = WithMember(facts, layout.members.back());
    }
    if (facts.height > MessageType::kDeepest) FailDepth(definition.name);
    if (facts.leaves > MessageType::kMostLeaves) {
      throw DefinitionError(
          fmt::format("{}: more than {} fields", definition.name, MessageType::kMostLeaves));
    }
    if (layout.members.empty()) layout.members.push_back(Filler());
    structs_[index] = WithSizes(std::move(layout));
    facts_[index] = facts;
    return index;
  }

  [[noreturn]] static void FailDepth(const std::string& name) {
    throw DefinitionError(
        fmt::format("{}: nested deeper than {} messages", name, MessageType::kDeepest));
  }

  static constexpr const char* kFillerName = "structure_needs_at_least_one_member";

  static Member Filler() {
    Member filler;
    filler.name = kFillerName;
    filler.type = FieldType::kUint8;
    filler.is_filler = true;
    return filler;
  }

  Member MemberOf(const FieldDefinition& field, const MessageDefinition& owner, int depth) {
    Member member;
    member.name = field.name;
    member.multiplicity = field.multiplicity;
    member.count = field.multiplicity == Multiplicity::kOne ? 1 : field.count;
    member.string_bound = field.string_bound;
    member.is_filler = field.name == kFillerName;
    if (const auto primitive = PrimitiveNamed(field.type)) {
      member.type = *primitive;
    } else {
      member.type = FieldType::kStruct;
      member.struct_index = StructNamed(field, owner, depth);
    }
    return member;
  }

  std::uint32_t StructNamed(const FieldDefinition& field, const MessageDefinition& owner,
                            int depth) {
    std::string name = field.type;
    auto found = find_(name);
    if (!found && ShortTypeName(name) == "Header") found = find_(name = "std_msgs/msg/Header");
    if (!found) {
      throw DefinitionError(fmt::format("{}: {}: no definition of {}{}", owner.name, field.name,
                                        field.type, NearestPrimitive(field.type)));
    }
    const auto known = index_.find(name);
    if (known == index_.end()) {
      found->name = name;
      return Add(*found, depth + 1);
    }
    if (facts_[known->second].height == 0) {
      throw DefinitionError(
          fmt::format("{}: {}: {} contains itself", owner.name, field.name, name));
    }
    return known->second;
  }

  static std::string NearestPrimitive(const std::string& type) {
    return core::DidYouMean(ShortTypeName(type), {"bool", "byte", "char", "int8", "uint8", "int16",
                                                  "uint16", "int32", "uint32", "int64", "uint64",
                                                  "float32", "float64", "string", "wstring"});
  }

  [[nodiscard]] Facts WithMember(Facts facts, const Member& member) const {
    Facts of_member{0, 1};
    if (member.type == FieldType::kStruct) of_member = facts_[member.struct_index];
    facts.height = std::max(facts.height, 1 + of_member.height);
    facts.leaves = CappedSum(facts.leaves, of_member.leaves);
    return facts;
  }

  [[nodiscard]] StructLayout WithSizes(StructLayout layout) const {
    for (const Member& member : layout.members) {
      const bool is_struct = member.type == FieldType::kStruct;
      layout.has_bool |=
          is_struct ? structs_[member.struct_index].has_bool : member.type == FieldType::kBool;
      layout.smallest = CappedSum(layout.smallest, SmallestOf(member));
    }
    layout.is_time = IsTimeLayout(layout.members);
    for (const CdrVersion version : {CdrVersion::kXcdr1, CdrVersion::kXcdr2}) {
      layout.extent[static_cast<std::size_t>(version)] = ExtentOf(layout, version);
    }
    return layout;
  }

  [[nodiscard]] std::uint64_t SmallestOf(const Member& member) const {
    constexpr std::uint64_t kLengthBytes = 4;
    if (member.multiplicity == Multiplicity::kSequence) return kLengthBytes;
    std::uint64_t one = IsText(member.type) ? kLengthBytes : SizeOf(member.type);
    if (member.type == FieldType::kStruct) one = structs_[member.struct_index].smallest;
    return CappedProduct(one, member.count);
  }

  [[nodiscard]] std::optional<FixedExtent> ExtentOf(const StructLayout& layout,
                                                    CdrVersion version) const {
    if (version == CdrVersion::kXcdr2 && layout.extensibility == Extensibility::kAppendable) {
      return std::nullopt;
    }
    FixedExtent extent{};
    for (const Member& member : layout.members) {
      const auto next = ExtentOf(member, version);
      if (!next) return std::nullopt;
      extent = Joined(extent, *next);
    }
    return extent;
  }

  [[nodiscard]] std::optional<FixedExtent> ExtentOf(const Member& member,
                                                    CdrVersion version) const {
    if (member.multiplicity == Multiplicity::kSequence || IsText(member.type)) return std::nullopt;
    if (member.type != FieldType::kStruct) {
      return NumbersExtent(SizeOf(member.type), member.count, version);
    }
    const auto& one = structs_[member.struct_index].ExtentIn(version);
    if (member.multiplicity == Multiplicity::kOne || !one) return one;
    if (version == CdrVersion::kXcdr2) return std::nullopt;  // arrays of structs have a delimiter
    return Repeated(*one, member.count);
  }

  const FindDefinition& find_;
  std::vector<StructLayout> structs_;
  std::vector<Facts> facts_;
  std::map<std::string, std::uint32_t> index_;
};

void ListLeavesOf(const MessageType& type, const StructLayout& layout, const std::string& prefix,
                  std::vector<LeafShape>& leaves) {
  for (const Member& member : layout.members) {
    if (member.is_filler) continue;
    if (member.type != FieldType::kStruct) {
      leaves.push_back({prefix + member.name, member.type, member.multiplicity, member.count});
      continue;
    }
    const char* elements = member.multiplicity == Multiplicity::kOne ? "." : "[].";
    ListLeavesOf(type, type.StructOf(member), prefix + member.name + elements, leaves);
  }
}

}  // namespace

MessageType::MessageType(const MessageDefinition& root, const FindDefinition& find)
    : structs_(TypeBuilder(find).Build(root)) {
  for (const StructLayout& layout : structs_) {
    for (const Member& member : layout.members) has_wstring_ |= member.type == FieldType::kWstring;
  }
}

MessageType MessageType::WithWideChars(int bytes) const {
  MessageType type = *this;
  type.wide_char_bytes_ = bytes;
  return type;
}

std::vector<LeafShape> ListLeaves(const MessageType& type) {
  std::vector<LeafShape> leaves;
  ListLeavesOf(type, type.root(), "", leaves);
  return leaves;
}

std::string DescribeType(const MessageType& type, const Member& member) {
  std::string text(member.type == FieldType::kStruct ? type.StructOf(member).name
                                                     : NameOf(member.type));
  if (member.string_bound > 0) text += fmt::format("<={}", member.string_bound);
  if (member.multiplicity == Multiplicity::kArray) return fmt::format("{}[{}]", text, member.count);
  if (member.multiplicity == Multiplicity::kOne) return text;
  return text + (member.count == 0 ? "[]" : fmt::format("[<={}]", member.count));
}

}  // namespace scoria::logs
