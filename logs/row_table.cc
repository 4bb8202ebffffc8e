// SPDX-License-Identifier: BSD-3-Clause
#include "logs/row_table.h"

#include <array>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

/// Lists the numbers of a group with their paths. Of what is absent the paths are there, without
/// a value.
class CellLister {
 public:
  CellLister(std::string prefix, bool is_present)
      : prefix_(std::move(prefix)), is_present_(is_present) {}

  template <class T>
  void operator()(const char* name, T& value) {
    List(prefix_ + "." + name, value);
  }

  struct Cell {
    std::string path, text;
  };
  std::vector<Cell> cells;

 private:
  template <class T>
  void List(const std::string& path, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      Add(path, value ? "1" : "0");
    } else if constexpr (std::is_arithmetic_v<T>) {
      Add(path, fmt::format("{}", value));
    } else if constexpr (IsArray<T>::value) {
      for (std::size_t i = 0; i < value.size(); ++i) List(fmt::format("{}[{}]", path, i), value[i]);
    } else if constexpr (IsOptional<T>::value) {
      typename T::value_type none{};
      const bool outer = std::exchange(is_present_, is_present_ && value.has_value());
      List(path, value ? *value : none);
      is_present_ = outer;
    } else {
      const std::string outer = std::exchange(prefix_, path);
      value.Serialize(*this);
      prefix_ = outer;
    }
  }

  void Add(const std::string& path, std::string text) {
    cells.push_back({path, is_present_ ? std::move(text) : std::string()});
  }

  std::string prefix_;
  bool is_present_;
};

/// Calls visit(cell) for every column of the groups wanted, time apart.
template <class Visit>
void ForEachCell(const Row& row, const RowGroups& groups, const Visit& visit) {
  ForEachGroup(row, [&]<class Group>(const std::optional<Group>& group) {
    const auto number = static_cast<std::size_t>(Group::kGroup);
    if (!groups[number]) return;
    Group content = group.value_or(Group{});
    CellLister lister(std::string(EnumNames(RowGroup{})[number].second), group.has_value());
    content.Serialize(lister);
    for (CellLister::Cell& cell : lister.cells) visit(cell);
  });
}

}  // namespace

RowTable::RowTable(const RowGroups& groups) : groups_(groups), columns_{"time_s"} {
  ForEachCell(Row{}, groups_,
              [&](CellLister::Cell& cell) { columns_.push_back(std::move(cell.path)); });
}

std::span<const std::string> RowTable::Read(const Row& row) {
  cells_.assign(1, fmt::format("{}", row.time_s));
  ForEachCell(row, groups_,
              [&](CellLister::Cell& cell) { cells_.push_back(std::move(cell.text)); });
  return cells_;
}

}  // namespace scoria::logs
