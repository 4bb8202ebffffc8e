// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace scoria::logs {

using Bytes = std::vector<std::byte>;

}  // namespace scoria::logs
