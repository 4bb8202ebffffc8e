// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace scoria::test {

inline constexpr std::int64_t kMs = 1'000'000;  // in nanoseconds

}  // namespace scoria::test
