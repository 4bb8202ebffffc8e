// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace scoria::app {

/// Adds the commands that look at inputs without walking: `scoria info`, `scoria terrain`.
void AddInspection(CLI::App& app);

}  // namespace scoria::app
