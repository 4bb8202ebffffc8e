// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "logs/ros/definition.h"

namespace scoria::logs {

/// Bytes from where something of fixed layout is begun, at position p of a message's body, to its
/// end, by p mod 8: where it begins decides on its padding.
using FixedExtent = std::array<std::uint64_t, 8>;

/// Elements of an array: CDR's own limit.
inline constexpr std::uint64_t kLongestArray = std::numeric_limits<std::uint32_t>::max();

/// Alignment of 8-byte numbers: to 8 in XCDR1, to 4 in XCDR2.
enum class CdrVersion : std::uint8_t { kXcdr1, kXcdr2 };

/// One field of a struct.
struct Member {
  std::string name;
  FieldType type = FieldType::kBool;
  Multiplicity multiplicity = Multiplicity::kOne;
  std::uint64_t count = 1;         // of an array; bound of a sequence, 0 if it has none
  std::uint64_t string_bound = 0;  // characters; 0 if it has none
  std::uint32_t struct_index = 0;  // of kStruct, in MessageType::structs()
  bool is_filler = false;          // of a struct without fields, which is one byte on the wire
  bool operator==(const Member&) const = default;
};

struct StructLayout {
  std::string name;  // "pkg/msg/Name"
  std::vector<Member> members;
  Extensibility extensibility = Extensibility::kAsMessage;
  bool has_bool = false;       // here or in a struct within
  bool is_time = false;        // int32 sec, uint32 nanosec
  std::uint64_t smallest = 0;  // no value takes fewer bytes
  /// By CdrVersion, where every value takes the same bytes and has no delimiter within.
  std::array<std::optional<FixedExtent>, 2> extent;
  bool operator==(const StructLayout&) const = default;

  [[nodiscard]] const std::optional<FixedExtent>& ExtentIn(CdrVersion version) const noexcept {
    return extent[static_cast<std::size_t>(version)];
  }
};

/// Looks a message up by its full name; nothing if there is none.
using FindDefinition = std::function<std::optional<MessageDefinition>(const std::string&)>;

/// A message type with all that it is made of, as a flat table of structs.
class MessageType {
 public:
  /// @param find  for the types that `root` uses, and those that these use. A type "pkg/msg/Header"
  ///              that is not there is std_msgs/msg/Header.
  /// Errors: DefinitionError for a type that is not there, contains itself or is nested deeper than
  /// kDeepest structs, and for more than kMostLeaves fields.
  MessageType(const MessageDefinition& root, const FindDefinition& find);

  static constexpr int kDeepest = 64;
  static constexpr std::uint64_t kMostLeaves = 1'000'000;

  [[nodiscard]] const std::string& name() const noexcept { return structs_[0].name; }
  [[nodiscard]] const StructLayout& root() const noexcept { return structs_[0]; }
  [[nodiscard]] const std::vector<StructLayout>& structs() const noexcept { return structs_; }
  [[nodiscard]] const StructLayout& StructOf(const Member& member) const noexcept {
    return structs_[member.struct_index];
  }
  [[nodiscard]] bool has_wstring() const noexcept { return has_wstring_; }

  /// Bytes of one character of a wstring, 4 (Fast DDS) or 2: DDS vendors differ.
  [[nodiscard]] int wide_char_bytes() const noexcept { return wide_char_bytes_; }
  [[nodiscard]] MessageType WithWideChars(int bytes) const;

  bool operator==(const MessageType&) const = default;

 private:
  std::vector<StructLayout> structs_;  // the root first
  bool has_wstring_ = false;
  int wide_char_bytes_ = 4;
};

/// A field that holds numbers or text, by its path with "[]" for every element of an array or
/// sequence of structs: "motor_state[].q". An array of numbers or texts is one leaf.
struct LeafShape {
  std::string path;
  FieldType type = FieldType::kBool;
  Multiplicity multiplicity = Multiplicity::kOne;
  std::uint64_t count = 1;  // as in Member
};

/// All leaves in the order of the message.
[[nodiscard]] std::vector<LeafShape> ListLeaves(const MessageType& type);

/// "float64", "float64[3]", "string[]", "uint8[<=4]", "unitree_go/msg/MotorState[20]".
[[nodiscard]] std::string DescribeType(const MessageType& type, const Member& member);

}  // namespace scoria::logs
