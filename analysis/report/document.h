// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {

/// What the head of a report shows beside the verdicts.
struct ReportPicture {
  std::string jpeg, caption;
};

struct Heading {
  std::string text;
};

struct Paragraph {
  std::string text;
};

/// Small print: how to read what stands above.
struct Note {
  std::string text;
};

struct BulletList {
  std::vector<std::string> items;
};

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A figure and the sentence below it.
struct CaptionedFigure {
  Figure figure;
  std::string caption;
  // Of DrawFigures: the drawing, or why there is none.
  std::optional<std::string> svg = std::nullopt;
  std::string problem = {};
};

struct VideoLink {
  std::string path, caption;  // relative to the page
};

using Block = std::variant<Heading, Paragraph, Note, BulletList, Table, CaptionedFigure, VideoLink>;
using Blocks = std::vector<Block>;

/// The first screen: text beside a picture, and what stands below both.
struct DocumentHead {
  Blocks text, below;
  std::optional<ReportPicture> picture;
};

struct Chapter {
  std::string key;  // its anchor
  std::string title;
  Blocks blocks;
};

/// A report without a form: ToHtml and ToPlainText give it one.
struct Document {
  std::string title;
  DocumentHead head;
  std::vector<Chapter> chapters;
  std::vector<std::string> not_shown;  // the sections that say nothing here, and why
};

/// "TITLE: this figure could not be drawn: PROBLEM".
[[nodiscard]] std::string MissingFigure(const CaptionedFigure& figure);

/// Draws every figure of the chapters into a folder. One that gnuplot refuses has its problem.
[[nodiscard]] Document DrawFigures(Document document, const std::filesystem::path& folder);

}  // namespace scoria::analysis
