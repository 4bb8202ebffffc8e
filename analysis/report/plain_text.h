// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/report/document.h"

namespace scoria::analysis {

/// The document for a terminal or a mail: tables in columns; figures, picture and videos by name
/// and caption. A paragraph is one line.
[[nodiscard]] std::string ToPlainText(const Document& document);

}  // namespace scoria::analysis
