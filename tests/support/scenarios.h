// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "app/scenario/scenario.h"

namespace scoria::test {

/// A scenario of the repository with overrides.
app::Scenario LoadScenario(const std::string& name, const std::vector<std::string>& overrides = {});

}  // namespace scoria::test
