// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "logs/embedded_text.h"

namespace scoria::logs {

/// The files of the folder mappings; its text is generated from them.
[[nodiscard]] std::span<const EmbeddedText> EmbeddedMappings();

}  // namespace scoria::logs
