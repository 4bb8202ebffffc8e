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
  // By TypeChoice:
  std::uint64_t fits = 0, misfits = 0;
  std::string first_misfit;  // why
};

/// Which definition the messages of one channel follow. Two layouts may have one name, and a
/// definition in a log may be wrong, so that the messages decide:
/// - a definition is taken if every message shown fits it to the last byte, the log's own first;
/// - the log's own is taken all the same if some fit it and no other definition fits all.
/// Before any message is shown the first one is taken.
class TypeChoice {
 public:
  /// @param problem  why there are no candidates, or not the log's own; may be empty.
  TypeChoice(std::string type_name, std::vector<TypeCandidate> candidates, std::string problem);

  /// Holds a message against the definitions that may still be taken.
  void Show(std::span<const std::byte> message);

  /// True when no further message can change what is taken.
  [[nodiscard]] bool IsSettled() const noexcept;

  /// What is taken; null if nothing fits. Valid as long as this object, and until it is moved.
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
