// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace scoria::app {

/// Every key of scenarios and campaigns with kind, default, range and meaning, as the Markdown of
/// docs/CONFIG.md.
[[nodiscard]] std::string ConfigMarkdown();

/// The keys of a kind of ConfigKinds() as a JSON Schema, for editors that complete and check YAML.
[[nodiscard]] std::string ConfigJsonSchema(std::string_view kind);

}  // namespace scoria::app
