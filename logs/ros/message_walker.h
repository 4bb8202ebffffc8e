// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include <fmt/format.h>

#include "logs/ros/cdr_cursor.h"
#include "logs/ros/field_view.h"
#include "logs/ros/message_error.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// Walks the bytes of a message along its type and shows a handler what is there. Every read is
/// checked against the bytes that are there; nothing is allocated.
///
/// A handler is a small value that stands for one struct, member or element:
///   Handler Child(const StructLayout&, std::size_t i) const   for member i of the struct;
///   Handler Element(std::size_t i) const      for an element of several structs;
///   bool MaySkip(const StructLayout&) const   if it need not see anything of such a struct;
///   void Leaf(const FieldView&) const         numbers or texts: one, or all of several;
///   void Time(const FieldView&) const         sec and nanosec as one, before they are shown.
template <class Handler>
class MessageWalker {
 public:
  /// Errors, here and below: MessageError.
  MessageWalker(const MessageType& type, std::span<const std::byte> message)
      : type_(type), message_(message) {}

  /// @returns how many bytes are left behind the last field.
  std::size_t Walk(const Handler& handler) {
    try {
      cursor_.emplace(message_);
      WalkStruct(type_.root(), handler);
      return cursor_->left();
    } catch (const CdrFault& fault) {
      const char* colon = fault.path.empty() ? "" : ": ";
      throw MessageError(fmt::format("{}{}{}: {}", type_.name(), colon, fault.path, fault.rule));
    }
  }

 private:
  [[nodiscard]] bool IsDelimited(const StructLayout& layout) const {
    const Encapsulation& e = cursor_->encapsulation();
    if (e.version == CdrVersion::kXcdr1) return false;
    if (layout.extensibility == Extensibility::kAsMessage) return e.is_delimited;
    return layout.extensibility == Extensibility::kAppendable;
  }

  /// The bytes of a struct where these are always the same; null where they are not.
  [[nodiscard]] const FixedExtent* ExtentOf(const StructLayout& layout) const {
    const Encapsulation& e = cursor_->encapsulation();
    if (e.is_delimited) return nullptr;
    const auto& extent = layout.ExtentIn(e.version);
    return extent ? &*extent : nullptr;
  }

  void WalkStruct(const StructLayout& layout, const Handler& handler) {
    std::optional<std::size_t> end;
    if (IsDelimited(layout)) end = cursor_->TakeDelimiter();
    if (layout.is_time) handler.Time(ViewOfTime());
    for (std::size_t i = 0; i < layout.members.size(); ++i) {
      try {
        WalkMember(layout.members[i], handler.Child(layout, i));
      } catch (CdrFault& fault) {
        const char* dot = fault.path.empty() || fault.path[0] == '[' ? "" : ".";
        fault.path = layout.members[i].name + dot + fault.path;
        throw;
      }
    }
    if (end) cursor_->ExpectEnd(*end);
  }

  void WalkMember(const Member& member, const Handler& handler) {
    if (member.type == FieldType::kStruct) {
      WalkStructs(member, handler);
    } else if (IsText(member.type)) {
      WalkTexts(member, handler);
    } else {
      WalkNumbers(member, handler);
    }
  }

  void WalkStructs(const Member& member, const Handler& handler) {
    const StructLayout& layout = type_.StructOf(member);
    if (member.multiplicity == Multiplicity::kOne) {
      if (const FixedExtent* extent = ExtentOf(layout); extent && handler.MaySkip(layout)) {
        return cursor_->TakeExtent(*extent);
      }
      return WalkStruct(layout, handler);
    }
    const std::optional<std::size_t> end = TakeCollectionDelimiter();
    const std::uint64_t count = CountOf(member, layout.smallest);
    for (std::uint64_t i = 0; i < count; ++i) WalkElement(layout, handler.Element(i), i);
    if (end) cursor_->ExpectEnd(*end);
  }

  void WalkElement(const StructLayout& layout, const Handler& handler, std::uint64_t i) {
    try {
      if (const FixedExtent* extent = ExtentOf(layout); extent && handler.MaySkip(layout)) {
        return cursor_->TakeExtent(*extent);
      }
      WalkStruct(layout, handler);
    } catch (CdrFault& fault) {
      fault.path = fmt::format("[{}]{}{}", i, fault.path.empty() ? "" : ".", fault.path);
      throw;
    }
  }

  void WalkNumbers(const Member& member, const Handler& handler) {
    const std::uint64_t count = CountOf(member, SizeOf(member.type));
    // An empty sequence is not aligned for the elements that it has not.
    const std::byte* const data =
        count == 0 ? cursor_->here() : cursor_->Take(SizeOf(member.type), count);
    if (member.type == FieldType::kBool) CheckBools(member, {data, count});
    handler.Leaf(ViewOf(member, data, count));
  }

  void WalkTexts(const Member& member, const Handler& handler) {
    constexpr std::uint64_t kLengthBytes = 4;
    std::optional<std::size_t> end;
    if (member.multiplicity != Multiplicity::kOne) end = TakeCollectionDelimiter();
    const std::uint64_t count = CountOf(member, kLengthBytes);
    const std::byte* first = cursor_->here();
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::byte* const text = TakeText(member, i);
      if (i == 0) first = text;
    }
    if (end) cursor_->ExpectEnd(*end);
    handler.Leaf(ViewOf(member, first, count));
  }

  const std::byte* TakeText(const Member& member, std::uint64_t i) {
    try {
      if (member.type == FieldType::kString) return cursor_->TakeString(member.string_bound);
      return cursor_->TakeWstring(member.string_bound, type_.wide_char_bytes());
    } catch (CdrFault& fault) {
      if (member.multiplicity != Multiplicity::kOne) fault.path = fmt::format("[{}]", i);
      throw;
    }
  }

  std::optional<std::size_t> TakeCollectionDelimiter() {
    if (cursor_->encapsulation().version == CdrVersion::kXcdr1) return std::nullopt;
    return cursor_->TakeDelimiter();
  }

  std::uint64_t CountOf(const Member& member, std::uint64_t smallest) {
    if (member.multiplicity != Multiplicity::kSequence) return member.count;
    return cursor_->TakeLength(member.count, smallest);
  }

  void CheckBools(const Member& member, std::span<const std::byte> bools) {
    for (std::size_t i = 0; i < bools.size(); ++i) {
      if (std::to_integer<int>(bools[i]) <= 1) continue;
      CdrFault fault;
      if (member.multiplicity != Multiplicity::kOne) fault.path = fmt::format("[{}]", i);
      fault.rule =
          fmt::format("a bool is 0 or 1, not {} (at byte {} of {})", std::to_integer<int>(bools[i]),
                      &bools[i] - message_.data(), message_.size());
      throw fault;
    }
  }

  [[nodiscard]] FieldView ViewOf(const Member& member, const std::byte* data,
                                 std::uint64_t count) const {
    return {member.type, data, count, cursor_->encapsulation().is_big_endian,
            type_.wide_char_bytes()};
  }

  [[nodiscard]] FieldView ViewOfTime() {
    cursor_->Align(4);
    cursor_->Need(8);
    return {FieldType::kTime, cursor_->here(), 1, cursor_->encapsulation().is_big_endian, 4};
  }

  const MessageType& type_;
  std::span<const std::byte> message_;
  std::optional<CdrCursor> cursor_;
};

}  // namespace scoria::logs
