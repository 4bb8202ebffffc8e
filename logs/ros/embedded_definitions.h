// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace scoria::logs {

struct EmbeddedText {
  std::string_view name;  // of the file
  std::string_view text;
};

/// The files of logs/ros/definitions, in the order in which logs/CMakeLists.txt lists them; its
/// text is generated from them.
[[nodiscard]] std::span<const EmbeddedText> EmbeddedDefinitions();

}  // namespace scoria::logs
