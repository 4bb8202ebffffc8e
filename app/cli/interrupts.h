// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace scoria::app {

/// True once the user has pressed Ctrl-C or the process was told to end. The first call starts to
/// catch these signals.
[[nodiscard]] const std::atomic<bool>& Interrupted();

}  // namespace scoria::app
