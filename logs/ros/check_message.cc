// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/check_message.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/ros/message_walker.h"

namespace scoria::logs {
namespace {

bool IsStrangeControl(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

bool IsReadable(std::string_view text) {
  return std::none_of(text.begin(), text.end(), IsStrangeControl) &&
         !core::FindInvalidUtf8(text).has_value();
}

void CheckText(std::string_view text) {
  if (IsReadable(text)) return;
  throw CdrFault{fmt::format("not a text: \"{}\"", core::Shown(text)), ""};
}

template <bool kChecksText>
struct CheckHandler {
  [[nodiscard]] CheckHandler Child(const StructLayout&, std::size_t) const { return {}; }
  [[nodiscard]] CheckHandler Element(std::size_t) const { return {}; }
  [[nodiscard]] bool MaySkip(const StructLayout& layout) const { return !layout.has_bool; }
  void Leaf(const FieldView& view) const {
    if (!kChecksText || view.type() != FieldType::kString) return;
    if (view.size() == 1) return CheckText(view.Text());
    for (const std::string& text : view.Texts()) CheckText(text);
  }
  void Time(const FieldView&) const {}
};

template <bool kChecksText>
std::size_t Walk(const MessageType& type, std::span<const std::byte> message) {
  using Handler = CheckHandler<kChecksText>;
  return MessageWalker<Handler>(type, message).Walk(Handler());
}

}  // namespace

std::size_t MeasureRest(const MessageType& type, std::span<const std::byte> message) {
  return Walk<false>(type, message);
}

void CheckMessage(const MessageType& type, std::span<const std::byte> message) {
  const std::size_t rest = Walk<true>(type, message);
  if (rest > kMostPadding) {
    throw MessageError(fmt::format(
        "{}: {} of {} bytes are left behind the last field (at most {} of padding are allowed)",
        type.name(), rest, message.size(), kMostPadding));
  }
}

}  // namespace scoria::logs
