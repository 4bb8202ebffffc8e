// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "logs/mapping/field_pattern.h"
#include "logs/mapping/message_reader.h"
#include "logs/mapping/signal_spec.h"

namespace scoria::logs {

/// Makes one signal of the messages of a channel.
class SignalDecoder {
 public:
  /// Looks the signal's fields up. @param spec  is borrowed.
  /// Errors: FieldPathError, PatternError.
  SignalDecoder(const SignalSpec& spec, const PatternNames& names, MessageReader& reader);

  [[nodiscard]] SignalId id() const noexcept { return spec_.id; }

  /// The signal of the message that the reader has read; absent if one of its numbers is.
  [[nodiscard]] std::optional<SignalValues> Decode(const MessageReader& reader);

 private:
  struct Place {
    std::size_t slot = 0, element = 0;
  };
  [[nodiscard]] Place FindPlace(const ExpandedPattern& pattern, const PatternPlace& place,
                                MessageReader& reader) const;
  [[nodiscard]] std::optional<double> Number(const MessageReader& reader, Place place) const;
  [[nodiscard]] std::optional<SignalValues> DecodeAttitude(const MessageReader& reader) const;
  bool UpdateNames(const MessageReader& reader);

  const SignalSpec& spec_;
  std::vector<Place> places_;  // in the log's order
  std::optional<std::size_t> names_slot_;
  std::vector<std::string> joint_names_;             // as last seen
  std::optional<std::array<std::size_t, 12>> from_;  // by these names
};

}  // namespace scoria::logs
