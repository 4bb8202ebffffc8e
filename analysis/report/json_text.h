// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace scoria::analysis {

/// JSON as text with a newline at its end. Bytes that are not UTF-8 become U+FFFD, so that no text
/// can keep a result from being written.
[[nodiscard]] std::string JsonText(const nlohmann::json& json);

}  // namespace scoria::analysis
