// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace scoria::app {

/// `scoria bench qp | model | estimator | physics | episode | workers | logs`.
void AddBench(CLI::App& app);

}  // namespace scoria::app
