// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/run_folder.h"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// What must not be overwritten unasked, in words; empty if nothing. An interrupted run and a
/// result that cannot be read are not kept.
std::string HoldsOf(const fs::path& folder) {
  if (fs::exists(folder / "campaign.json")) return "a campaign";
  const auto result = nlohmann::json::parse(core::ReadText(folder / "result.json"), nullptr, false);
  if (!result.is_object()) return "";
  const auto end = result.find("end");
  const bool finished = end != result.end() && end->is_string() && *end != "interrupted";
  return finished ? "a finished run" : "";
}

}  // namespace

RunFolder TakeRunFolder(const fs::path& out, const fs::path& preferred, bool force) {
  const bool named = !out.empty();
  const fs::path first = named ? out : preferred;
  for (int number = 1;; ++number) {
    const fs::path folder =
        number == 1 ? first : fs::path(fmt::format("{}-{}", first.string(), number));
    const std::string holds = force ? "" : HoldsOf(folder);
    if (named && !holds.empty()) {
      throw std::runtime_error(
          fmt::format("{}: holds {}; choose another folder by --out or overwrite it by --force",
                      folder.string(), holds));
    }
    if (!holds.empty()) continue;
    try {
      RunFolder taken{folder, std::make_unique<core::FolderLock>(folder)};
      if (force || HoldsOf(folder).empty()) return taken;  // not finished by another meanwhile
    } catch (const core::FolderInUse&) {
      if (named || force) throw;
    }
    if (named) --number;  // look again: now it holds a finished run
  }
}

}  // namespace scoria::app
