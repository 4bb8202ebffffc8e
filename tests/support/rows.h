// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "logs/row.h"

namespace scoria::test {

inline constexpr double kRow_s = 0.002;  // between rows of a log

/// A row with every group and every optional field, all zero but what is set: for tests that make
/// up a walk.
[[nodiscard]] inline logs::Row WholeRow() {
  logs::Row row;
  logs::ForEachGroup(row, [](auto& group) { group.emplace(); });
  row.true_contacts->p_WF_m.emplace();
  row.true_contacts->f_F_W_N.emplace();
  row.true_contacts->trunk_force_N.emplace();
  row.plan->leg_mode.emplace();
  row.plan->foot_target_m.emplace();
  row.contacts->source.emplace();
  row.contacts->f_F_W_N.emplace();
  row.contacts->sensor.emplace();
  row.contacts->observer.emplace();
  row.model->learned.emplace();
  return row;
}

/// Takes everything from a row that the robot's sensors cannot tell.
inline void DropTruth(logs::Row& row) {
  logs::ForEachGroup(row, []<class Group>(std::optional<Group>& group) {
    if (logs::IsTruth(Group::kGroup)) group.reset();
  });
}

}  // namespace scoria::test
