// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/document.h"

#include <exception>

#include <fmt/format.h>

#include "core/files.h"
#include "core/text.h"

namespace scoria::analysis {

std::string MissingFigure(const CaptionedFigure& figure) {
  return fmt::format("{}: this figure could not be drawn: {}", figure.figure.title(),
                     figure.problem);
}

Document DrawFigures(Document document, const std::filesystem::path& folder) {
  for (Chapter& chapter : document.chapters) {
    for (Block& block : chapter.blocks) {
      auto* f = std::get_if<CaptionedFigure>(&block);
      if (f == nullptr) continue;
      try {
        f->figure.Render(folder);
        f->svg = core::ReadText(folder / (f->figure.name() + ".svg"));
      } catch (const std::exception& e) {
        f->problem = core::PrintableText(e.what());
      }
    }
  }
  return document;
}

}  // namespace scoria::analysis
