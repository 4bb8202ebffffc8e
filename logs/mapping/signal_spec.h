// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/robot/legs.h"
#include "logs/mapping/mapping_file.h"
#include "logs/mapping/signals.h"

namespace scoria::logs {

/// One signal of a mapping, with all that says how its numbers become ours:
/// ours[k] = gain[k] * log's[from[k]] + offset[k].
struct SignalSpec {
  SignalId id = SignalId::kJointQ;
  std::string topic;   // a name of topics, or of the log; may be empty
  FieldSource source;  // its topic is not used
  std::array<std::size_t, 12> from{};
  std::array<double, 12> gain{}, offset{};
  bool is_rpy = false;  // an attitude as three angles
  QuaternionOrder order = QuaternionOrder::kXyzw;
  std::optional<double> above;  // a flag: 1 where the log's number is above
  std::string name_field;       // joints by the names of this field
};

/// The signals of a mapping file in the order of SignalId.
/// @pre FindProblem(file) is empty.
[[nodiscard]] std::vector<SignalSpec> ListSignals(const MappingFile& file);

/// What is wrong with a file whose keys are right one by one: the key, and why. Legs that are not
/// four different ones, axes that are none, a mapping of nothing.
struct FileProblem {
  std::string key, rule;
};
[[nodiscard]] std::optional<FileProblem> FindProblem(const MappingFile& file);

/// The log's legs in its order. @pre FindProblem(file) is empty.
[[nodiscard]] std::array<Leg, 4> LegsOf(const MappingFile& file);

}  // namespace scoria::logs
