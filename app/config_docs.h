// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace scoria::app {

/// Every key of a scenario with kind, default, range and meaning, as the Markdown of
/// docs/CONFIG.md.
[[nodiscard]] std::string ConfigMarkdown();

/// The same as a JSON Schema, for editors that complete and check YAML.
[[nodiscard]] std::string ConfigJsonSchema();

}  // namespace scoria::app
