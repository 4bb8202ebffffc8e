// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace scoria::app {

/// A line on standard error, which may be a file on a full disk: no exception then.
inline void Note(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

}  // namespace scoria::app
