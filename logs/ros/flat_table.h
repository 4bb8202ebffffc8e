// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "logs/ros/message_type.h"

namespace scoria::logs {

/// The fields of a message type as a tree, with the longest sequences that its messages hold.
class FlatShape {
 public:
  /// @param type  must outlive the shape and tables of it.
  explicit FlatShape(const MessageType& type);

  /// Whether messages differ in length, so that columns depend on Measure; by texts they do not.
  [[nodiscard]] bool varies() const noexcept { return root_.varies; }

  /// Takes the lengths of a message's sequences into account.
  /// Errors: MessageError, when those before the place have been taken.
  void Measure(std::span<const std::byte> message);

 private:
  friend class FlatTable;
  friend class MeasureHandler;
  friend class CellHandler;
  struct Node {
    const Member* member = nullptr;  // null: the message
    bool varies = false;             // a sequence, here or within
    std::uint64_t width = 1;         // elements, of a sequence the most seen
    std::vector<Node> children;      // of a struct, by member
    // Of a table:
    bool is_list = false;          // all elements are in one cell per leaf
    std::size_t first_column = 0;  // beside that of the element that it is in
    std::size_t columns = 1;       // of one element
  };
  [[nodiscard]] static Node MakeNode(const MessageType& type, const Member* member);

  const MessageType* type_;
  Node root_;
};

/// Messages of a type as rows of text: a cell per number or text, named by its path. Elements of
/// arrays and sequences are columns of their own, "motor_state[3].q", up to the longest sequence
/// of the shape; cells of elements that a message has not are empty. An array or sequence that
/// would need more than kMostColumns has one column per leaf, "points[].x", whose cells are JSON
/// lists. Numbers read back to the same value: shortest digits of floats; bools are 1 and 0.
class FlatTable {
 public:
  static constexpr std::uint64_t kMostColumns = 1024;

  explicit FlatTable(FlatShape shape);

  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }

  /// The cells of a message, until the next call.
  /// @pre the shape has measured the message, if it varies.
  /// Errors: MessageError.
  [[nodiscard]] std::span<const std::string> Read(std::span<const std::byte> message);

 private:
  friend class CellHandler;
  static std::size_t LayOut(FlatShape::Node& node);
  void AppendNames(const FlatShape::Node& node, const std::string& path, bool in_list);

  FlatShape shape_;
  std::vector<std::string> columns_, cells_;
  std::vector<bool> lists_;  // by column
};

}  // namespace scoria::logs
