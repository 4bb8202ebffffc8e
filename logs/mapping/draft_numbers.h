// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "logs/mapping/field_catalog.h"

namespace scoria::logs {

/// A signal in a table without names, by what its numbers are like.
struct NumberGuess {
  std::string section, key;
  std::size_t first = 0;  // column
  std::string options;    // ", order: wxyz"
  std::string why;
};

/// Finds joints by the knees, which bend one way, and by rates that are derivatives; attitudes of
/// length 1; accelerations of the length of gravity.
[[nodiscard]] std::vector<NumberGuess> GuessByNumbers(const CatalogTopic& topic);

/// Of the vector that some fields are: mean and standard deviation of its length.
[[nodiscard]] double MeanNorm(const std::vector<const CatalogField*>& fields);
[[nodiscard]] double SpreadOfNorm(const std::vector<const CatalogField*>& fields);

}  // namespace scoria::logs
