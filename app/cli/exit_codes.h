// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace scoria::app {

/// Of `scoria`. docs/commands.md says when each is given.
enum ExitCode { kOk = 0, kFailed = 1, kBadInput = 2, kStopped = 3, kFileError = 4 };

}  // namespace scoria::app
