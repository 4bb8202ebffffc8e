// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logs/ros/definition_source.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// What a log says of the messages of a channel.
struct ChannelSchema {
  std::string type_name;         // "pkg/msg/Name"; "pkg/Name" is that as well
  std::string message_encoding;  // "cdr" is decoded
  std::string schema_encoding;   // "ros2msg", "ros2idl"; empty where the log has no definition
  std::string schema_text;
};

/// One definition that a channel may follow.
struct TypeCandidate {
  MessageType type;
  std::string origin;   // "the bag", "built in, N = 20", "the bag, std_msgs/msg/Header built in"
  bool is_own = false;  // the log's, with all that it uses
  // By TypeChoice, of the messages shown:
  std::uint64_t fits = 0, misfits = 0;
  std::string first_misfit;     // why
  std::uint64_t with_rest = 0;  // of those that fit an own definition: more than padding is left
};

/// Which definition the messages of one channel follow. Two layouts may have one name, and a
/// definition in a log may be wrong, so that the messages decide:
/// - the log's own is taken if every message shown can be read by it; that it leaves bytes over is
///   said, not held against it (widths of wstrings are told apart as if they were not its own);
/// - else the first other one is that every message fits to the last byte, as CheckMessage has it;
/// - else the log's own, if some messages can be read by it.
/// Before any message is shown the first one is taken.
class TypeChoice {
 public:
  /// @param candidates  the likeliest first.
  /// @param problem     why there are no candidates, or not the log's own; may be empty.
  TypeChoice(std::string type_name, std::vector<TypeCandidate> candidates, std::string problem);

  /// Holds a message against the definitions that may still be taken.
  void Show(std::span<const std::byte> message);

  /// True when no further message can change what is taken.
  [[nodiscard]] bool IsSettled() const noexcept;

  /// What is taken; null if nothing fits. Valid as long as this object or the one it is moved to.
  [[nodiscard]] const TypeCandidate* taken() const noexcept;

  /// One line for a report: what is taken ("the bag"; "built in, N = 20"), or why nothing is.
  [[nodiscard]] std::string Report() const;

 private:
  std::string type_name_;
  std::vector<TypeCandidate> candidates_;
  std::string problem_;
  std::uint64_t shown_ = 0;
};

/// Finds the definitions of message types: those of the log, of the folders that the user names,
/// and the built-in ones, in this order.
class TypeResolver {
 public:
  /// @param msg_paths  folders as ScanDefinitionFolder reads them.
  /// Errors: DefinitionError for a folder that is not there or holds no definition.
  explicit TypeResolver(const std::vector<std::filesystem::path>& msg_paths = {});

  /// The definitions that a channel may follow. What cannot be read (a wrong text, an encoding
  /// other than CDR) is said by TypeChoice::Report.
  [[nodiscard]] TypeChoice Resolve(const ChannelSchema& channel) const;

 private:
  struct Source {
    std::unique_ptr<DefinitionSource> definitions;
    bool any_package = false;  // its types have no package of their own
  };

  std::vector<Source> sources_;
};

}  // namespace scoria::logs
