// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "logs/embedded_text.h"

namespace scoria::logs {

/// The files of logs/ros/definitions, in the order in which logs/CMakeLists.txt lists them; its
/// text is generated from them.
[[nodiscard]] std::span<const EmbeddedText> EmbeddedDefinitions();

}  // namespace scoria::logs
