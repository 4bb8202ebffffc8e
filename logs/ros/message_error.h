// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace scoria::logs {

/// Bytes that are not a message of their type: "pkg/msg/Name: path.of[2].field: rule (at byte N)".
/// Bytes are counted from the first of the message, its four-byte encapsulation included.
struct MessageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace scoria::logs
