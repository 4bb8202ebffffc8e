// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <string>

#include "logs/row_groups.h"

namespace scoria::logs {

/// One instant of a walk, as analysis sees it, simulated or recorded in the field: a time, and what
/// is known of it.
struct Row {
  double time_s = 0.0;
  std::optional<EpisodeRow> episode = std::nullopt;
  std::optional<TruthRow> truth = std::nullopt;
  std::optional<TrueJointsRow> true_joints = std::nullopt;
  std::optional<TrueContactsRow> true_contacts = std::nullopt;
  std::optional<TrueMassRow> true_mass = std::nullopt;
  std::optional<EnergyRow> energy = std::nullopt;
  std::optional<LedgerRow> ledger = std::nullopt;
  std::optional<MeasuredRow> measured = std::nullopt;
  std::optional<CommandRow> command = std::nullopt;
  std::optional<JointCommandRow> joint_command = std::nullopt;
  std::optional<PlanRow> plan = std::nullopt;
  std::optional<ReferenceRow> reference = std::nullopt;
  std::optional<EstimateRow> estimate = std::nullopt;
  std::optional<ContactsRow> contacts = std::nullopt;
  std::optional<ModelRow> model = std::nullopt;
  std::optional<SupervisionRow> supervision = std::nullopt;
  std::optional<SolveTimesRow> solve_times = std::nullopt;
  bool operator==(const Row&) const = default;
};

/// Calls visit(group) with every std::optional of a row, in the order of RowGroup.
template <class AnyRow, class Visit>
void ForEachGroup(AnyRow& row, Visit&& visit) {
  visit(row.episode);
  visit(row.truth);
  visit(row.true_joints);
  visit(row.true_contacts);
  visit(row.true_mass);
  visit(row.energy);
  visit(row.ledger);
  visit(row.measured);
  visit(row.command);
  visit(row.joint_command);
  visit(row.plan);
  visit(row.reference);
  visit(row.estimate);
  visit(row.contacts);
  visit(row.model);
  visit(row.supervision);
  visit(row.solve_times);
}

/// A group of a row with its time, as a message of the log.
template <class Group>
struct RowMessage {
  static constexpr const char* kTypeName = Group::kTypeName;
  double time_s = 0.0;
  Group group;
  template <class Archive>
  void Serialize(Archive& a) {
    a("time_s", time_s);
    group.Serialize(a);
  }
};

/// The topics of groups begin so; those of logs of version 0.1.0, where a row was one message, are
/// this without the last slash.
inline constexpr std::string_view kRowTopics = "/scoria/row/";

/// The topic of a group: "/scoria/row/truth".
[[nodiscard]] std::string TopicOf(RowGroup group);

/// True for groups that the robot's sensors cannot tell: a field log has them only where something
/// beside the robot measured, as motion capture.
[[nodiscard]] constexpr bool IsTruth(RowGroup group) noexcept {
  return group >= RowGroup::kTruth && group <= RowGroup::kLedger;
}

using RowGroups = std::bitset<kNumRowGroups>;  // by RowGroup

/// The groups that a row holds.
[[nodiscard]] RowGroups GroupsOf(const Row& row) noexcept;

}  // namespace scoria::logs
