// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace scoria::core {

/// A kind of file that is often given in place of another.
struct FileKind {
  std::string_view name;  // with its article, as "a PNG image"; empty: not known
  std::string_view hint;  // where it belongs, or what makes it usable; may be empty
};

/// What a file is by its first bytes (4 KiB are enough), whatever its name says. YAML, JSON and
/// plain text are not known.
[[nodiscard]] FileKind KindOfContent(std::string_view head);

/// "is a PNG image, not a YAML file (hint)".
[[nodiscard]] std::string NotOfKind(const FileKind& kind, std::string_view wanted);

inline constexpr std::string_view kUrdf = "a URDF", kXacro = "a xacro", kPng = "a PNG image",
                                  kEsriGrid = "an ESRI ASCII grid";

}  // namespace scoria::core
