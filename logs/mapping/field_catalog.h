// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// A number in the messages of a topic, and some of its values.
struct CatalogField {
  std::string path;            // as a mapping names it: "motor_state[3].q", "position[4]", a column
  std::vector<double> values;  // of the first messages
};

/// The numbers of one topic, or CSV file.
struct CatalogTopic {
  std::string topic, type;
  bool is_csv = false, has_names = true;        // a CSV file without header has none
  std::vector<CatalogField> fields;             // in the order of the message
  std::vector<std::string> text_arrays;         // paths of lists of texts, as name of JointState
  std::vector<std::vector<std::string>> texts;  // of these, in the first message
};

/// What the first messages of each topic hold; what cannot be decoded is left out.
[[nodiscard]] std::vector<CatalogTopic> CatalogFields(LogSource& log, const TypeResolver& resolver);

/// Fields that differ only in what a placeholder stands for.
struct FieldFamily {
  std::string pattern;  // with {leg}, {joint}, {axis}, {i} or {i+n}
  /// What the placeholders stand for, in the order in which the fields come.
  std::vector<std::string> legs, joints, axes;
  std::vector<const CatalogField*> fields;  // in the order of the log
};

/// The families of a topic that can be a signal: twelve joints or foot vectors, four legs, three or
/// four axes, twelve or more numbers counted by an index. Of overlapping ones the larger first.
[[nodiscard]] std::vector<FieldFamily> FindFamilies(const CatalogTopic& topic);

}  // namespace scoria::logs
