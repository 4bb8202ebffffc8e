// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/report/document.h"

namespace scoria::analysis {

/// One page without outside resources. All text is escaped; drawings and the picture are embedded,
/// videos linked. Every chapter is a heading with its key as anchor.
[[nodiscard]] std::string ToHtml(const Document& document);

[[nodiscard]] std::string EscapeHtml(const std::string& text);

}  // namespace scoria::analysis
