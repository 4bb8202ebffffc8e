// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <urdf_world/types.h>

namespace scoria::core {

/// The tree of a URDF text; `file` stands for it in messages.
/// Errors: ConfigError if it is a file of another kind, not UTF-8 outside of its comments, or
/// anything that urdfdom complains about (which itself goes on with zeros).
[[nodiscard]] urdf::ModelInterfaceSharedPtr ParseUrdf(const std::string& text,
                                                      const std::string& file);

}  // namespace scoria::core
