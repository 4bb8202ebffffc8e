// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "core/math/types.h"

namespace scoria::analysis {

/// Mean colour of an image, red, green and blue in [0, 1]; nothing if it cannot be read. What is
/// transparent does not count.
[[nodiscard]] std::optional<Vec3> MeanColour(const std::filesystem::path& image);

}  // namespace scoria::analysis
