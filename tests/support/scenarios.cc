// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/scenarios.h"

#include "tests/support/robots.h"

namespace scoria::test {

app::Scenario LoadScenario(const std::string& name, const std::vector<std::string>& overrides) {
  return app::LoadScenario(SourcePath("scenarios/" + name + ".yaml"), overrides);
}

}  // namespace scoria::test
