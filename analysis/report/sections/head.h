// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/report/report_input.h"

namespace scoria::analysis {

/// The first screen: who falls less, on how many metres, what this budget could have seen, in how
/// many places the falls lie; and a picture.
[[nodiscard]] DocumentHead BuildHead(const ReportInput& input);

/// How to read a verdict.
[[nodiscard]] Note VerdictNote();

}  // namespace scoria::analysis
