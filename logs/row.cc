// SPDX-License-Identifier: BSD-3-Clause
#include "logs/row.h"

#include <algorithm>

namespace scoria::logs {

std::string TopicOf(RowGroup group) {
  constexpr auto kNames = EnumNames(RowGroup{});
  const auto found = std::find_if(kNames.begin(), kNames.end(),
                                  [group](const auto& named) { return named.first == group; });
  return std::string(kRowTopics) + std::string(found->second);
}

RowGroups GroupsOf(const Row& row) noexcept {
  RowGroups groups;
  ForEachGroup(row, [&]<class Group>(const std::optional<Group>& group) {
    groups[static_cast<std::size_t>(Group::kGroup)] = group.has_value();
  });
  return groups;
}

}  // namespace scoria::logs
