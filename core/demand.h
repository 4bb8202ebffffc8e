// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

/// Always armed check for programmer mistakes: aborts with the condition and the values given.
/// Never for user input.
#define SCORIA_DEMAND(condition, ...)                                                       \
  do {                                                                                      \
    if (!(condition)) {                                                                     \
      fmt::print(stderr, "{}:{}: demand failed: {} [{}]\n", __FILE__, __LINE__, #condition, \
                 fmt::format("" __VA_ARGS__));                                              \
      std::abort();                                                                         \
    }                                                                                       \
  } while (false)
