// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/flat_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/demand.h"
#include "logs/ros/message_walker.h"

namespace scoria::logs {
namespace {

/// As JSON has it, with NaN and Infinity.
std::string ListValue(const FieldView& view, std::size_t i, const std::string& text) {
  if (IsText(view.type())) {
    std::string quoted = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += static_cast<unsigned char>(c) < 0x20
                    ? fmt::format("\\u{:04x}", static_cast<unsigned>(c))
                    : std::string(1, c);
    }
    return quoted + '"';
  }
  const bool is_float = view.type() == FieldType::kFloat32 || view.type() == FieldType::kFloat64;
  if (!is_float || std::isfinite(view.Double(i))) return text;
  if (std::isnan(view.Double(i))) return "NaN";
  return view.Double(i) > 0.0 ? "Infinity" : "-Infinity";
}

std::string CellText(const FieldView& view, std::size_t i) {
  if (view.type() == FieldType::kBool) return view.Int(i) != 0 ? "1" : "0";
  return view.Format(i);
}

}  // namespace

/// Widens the nodes of sequences.
class MeasureHandler {
 public:
  explicit MeasureHandler(FlatShape::Node& node) : node_(&node) {}

  [[nodiscard]] MeasureHandler Child(const StructLayout&, std::size_t i) const {
    return MeasureHandler(node_->children[i]);
  }
  [[nodiscard]] MeasureHandler Element(std::size_t i) const {
    Widen(i + 1);
    return *this;
  }
  [[nodiscard]] bool MaySkip(const StructLayout&) const { return !node_->varies; }
  void Leaf(const FieldView& view) const { Widen(view.size()); }
  void Time(const FieldView&) const {}

 private:
  void Widen(std::uint64_t width) const { node_->width = std::max(node_->width, width); }

  FlatShape::Node* node_;
};

/// Puts leaves into cells.
class CellHandler {
 public:
  CellHandler(FlatTable& table, const FlatShape::Node& node, std::size_t column)
      : table_(&table), node_(&node), column_(column) {}

  [[nodiscard]] CellHandler Child(const StructLayout&, std::size_t i) const {
    const FlatShape::Node& child = node_->children[i];
    return {*table_, child, column_ + child.first_column};
  }
  [[nodiscard]] CellHandler Element(std::size_t i) const { return {*table_, *node_, ColumnOf(i)}; }
  [[nodiscard]] bool MaySkip(const StructLayout&) const { return false; }
  void Leaf(const FieldView& view) const {
    if (node_->member->is_filler) return;
    if (IsText(view.type())) {
      const std::vector<std::string> texts = view.Texts();
      for (std::size_t i = 0; i < texts.size(); ++i) Put(view, i, texts[i]);
      return;
    }
    for (std::size_t i = 0; i < view.size(); ++i) Put(view, i, CellText(view, i));
  }
  void Time(const FieldView&) const {}

 private:
  [[nodiscard]] std::size_t ColumnOf(std::size_t element) const {
    return node_->is_list ? column_ : column_ + element * node_->columns;
  }

  void Put(const FieldView& view, std::size_t i, const std::string& text) const {
    const std::size_t column = ColumnOf(i);
    SCORIA_DEMAND(column < table_->cells_.size(), "{}", column);
    std::string& cell = table_->cells_[column];
    if (!table_->lists_[column]) {
      cell = text;
    } else {
      cell += (cell.size() > 1 ? "," : "") + ListValue(view, i, text);
    }
  }

  FlatTable* table_;
  const FlatShape::Node* node_;
  std::size_t column_;
};

FlatShape::Node FlatShape::MakeNode(const MessageType& type, const Member* member) {
  Node node;
  node.member = member;
  if (member != nullptr) {
    node.varies = member->multiplicity == Multiplicity::kSequence;
    node.width = node.varies ? 0 : member->count;
    if (member->type != FieldType::kStruct) return node;
  }
  const StructLayout& layout = member == nullptr ? type.root() : type.StructOf(*member);
  for (const Member& inner : layout.members) {
    node.children.push_back(MakeNode(type, &inner));
    node.varies |= node.children.back().varies;
  }
  return node;
}

FlatShape::FlatShape(const MessageType& type) : type_(&type), root_(MakeNode(type, nullptr)) {}

void FlatShape::Measure(std::span<const std::byte> message) {
  (void)MessageWalker<MeasureHandler>(*type_, message).Walk(MeasureHandler(root_));
}

FlatTable::FlatTable(FlatShape shape) : shape_(std::move(shape)) {
  LayOut(shape_.root_);
  AppendNames(shape_.root_, "", false);
  cells_.resize(columns_.size());
}

/// @returns how many columns a node takes.
std::size_t FlatTable::LayOut(FlatShape::Node& node) {
  if (node.member != nullptr && node.member->is_filler) return node.columns = 0;
  if (node.member == nullptr || node.member->type == FieldType::kStruct) {
    node.columns = 0;
    for (FlatShape::Node& child : node.children) {
      child.first_column = node.columns;
      node.columns += LayOut(child);
    }
  }
  const bool is_one = node.member == nullptr || node.member->multiplicity == Multiplicity::kOne;
  node.is_list = !is_one && node.columns > 0 && node.width > kMostColumns / node.columns;
  return node.is_list ? node.columns : node.columns * node.width;
}

void FlatTable::AppendNames(const FlatShape::Node& node, const std::string& path, bool in_list) {
  if (node.columns == 0) return;
  const auto append = [&](const std::string& name, bool is_list) {
    if (node.children.empty()) {
      columns_.push_back(name);
      lists_.push_back(is_list);
    }
    for (const FlatShape::Node& child : node.children)
      AppendNames(child, name + (name.empty() ? "" : ".") + child.member->name, is_list);
  };
  if (node.is_list) return append(path + "[]", true);
  if (node.member == nullptr || node.member->multiplicity == Multiplicity::kOne)
    return append(path, in_list);
  for (std::uint64_t i = 0; i < node.width; ++i) append(fmt::format("{}[{}]", path, i), in_list);
}

std::span<const std::string> FlatTable::Read(std::span<const std::byte> message) {
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i] = lists_[i] ? "[" : "";
  (void)MessageWalker<CellHandler>(*shape_.type_, message)
      .Walk(CellHandler(*this, shape_.root_, 0));
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (lists_[i]) cells_[i] += ']';
  }
  return cells_;
}

}  // namespace scoria::logs
