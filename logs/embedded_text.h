// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace scoria::logs {

/// A file that the program carries in itself.
struct EmbeddedText {
  std::string_view name;  // of the file
  std::string_view text;
};

}  // namespace scoria::logs
