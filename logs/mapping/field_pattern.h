// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "logs/mapping/signals.h"

namespace scoria::logs {

/// A pattern with a placeholder that means nothing.
struct PatternError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What placeholders stand for.
struct PatternNames {
  std::array<std::string, 4> legs;    // {leg}, in the log's order
  std::array<std::string, 3> joints;  // {joint}
  std::string_view axes = "xyz";      // {axis}, a letter each
  bool by_joint = false;              // arrays of joints go joint by joint
};

/// Where one number of a signal is.
struct PatternPlace {
  std::string path;
  std::size_t element = 0;  // of what the path names
  bool operator==(const PatternPlace&) const = default;
};

/// The places that a pattern means, in the log's order.
struct ExpandedPattern {
  std::vector<PatternPlace> places;
  std::size_t elements = 1;  // that each path must have
  bool is_vector = false;    // these elements are the axes of a vector
};

/// Puts every leg, joint and axis in place of {leg}, {joint} and {axis}. {i} is the number of the
/// value, from 0, over what has no placeholder in the pattern; {i+5} begins at 5. Without {i}, what
/// has no placeholder are the elements of the array or struct that a path names.
/// @param size  of an attitude that is three angles 3; else that of the shape.
/// Errors: PatternError.
[[nodiscard]] ExpandedPattern ExpandPattern(const std::string& pattern, SignalShape shape,
                                            std::size_t size, const PatternNames& names);

}  // namespace scoria::logs
