// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scoria::app {

/// Runs a program to its end, both its outputs into a file. It does not outlive this process.
/// @param arguments  the program first.
/// @returns its exit code; 128 and the signal that ended it; 127 if it could not be started.
/// Errors: std::runtime_error if there can be no process.
[[nodiscard]] int RunProgram(const std::vector<std::string>& arguments,
                             const std::filesystem::path& output);

}  // namespace scoria::app
