// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string_view>
#include <type_traits>

#include "core/similarity.h"

/// Configuration structs say once what they hold:
///
///     template <class Archive> void Serialize(Archive& a) {
///       a.Field("period_s", period_s, {.min = 0.1, .max = 2.0, .doc = "full gait cycle"});
///     }
///
/// and that drives reading, writing and documentation (archive.h). This header is all that such a
/// struct needs, so that it can be used without any reader of files.
/// Supported: bool, int, uint64_t, double, string, path (relative to the file that names it), enum
/// with EnumNames(), Vec3, array, vector, map by string, optional, struct with Serialize, and
/// std::variant of structs that each have kType, chosen by the key `type`. A struct with kScalarKey
/// and kListKey may be written as the one value, or the list, of that key. Names that were once
/// others are still read, with a note: of a key by FieldRule::was, of a struct's type by its
/// kFormerType, of an enum value by FormerNames(), like EnumNames().
namespace scoria::core {

struct FieldRule {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  const char* doc = "";
  const char* was = nullptr;             // the key's former name, still read, with a note
  double (*from_was)(double) = nullptr;  // a number under it as it reads today; none: the same
  Dimension scale = {};                  // by which the default goes with the robot (Similarity)
};

template <class T>
concept NamedEnum = std::is_enum_v<T> && requires {
  EnumNames(T{});
};

/// The name of an enum value, as configuration files and logs write it.
template <NamedEnum T>
[[nodiscard]] std::string_view EnumName(T value) {
  for (const auto& [v, name] : EnumNames(T{})) {
    if (v == value) return name;
  }
  return "?";
}

}  // namespace scoria::core
