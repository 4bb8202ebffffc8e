// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/plain_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace scoria::analysis {
namespace {

/// Characters of UTF-8.
std::size_t Width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

std::string Underlined(const std::string& text, char line) {
  const std::string shown = core::PrintableText(text);
  return fmt::format("{}\n{}\n\n", shown, std::string(Width(shown), line));
}

std::string RowText(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string cell = core::PrintableText(cells[i]);
    line += (i > 0 ? "  " : "") + cell;
    if (i + 1 < cells.size()) line.append(widths[i] - Width(cell), ' ');
  }
  return line + "\n";
}

struct BlockText {
  std::string operator()(const Heading& b) const { return Underlined(b.text, '-'); }
  std::string operator()(const Paragraph& b) const { return core::PrintableText(b.text) + "\n\n"; }
  std::string operator()(const Note& b) const { return core::PrintableText(b.text) + "\n\n"; }
  std::string operator()(const BulletList& b) const {
    std::string text;
    for (const std::string& item : b.items) text += "- " + core::PrintableText(item) + "\n";
    return text + "\n";
  }
  std::string operator()(const Table& b) const {
    std::vector<std::size_t> widths(b.header.size(), 0);
    const auto measure = [&](const std::vector<std::string>& cells) {
      for (std::size_t i = 0; i < cells.size(); ++i)
        widths[i] = std::max(widths[i], Width(core::PrintableText(cells[i])));
    };
    measure(b.header);
    for (const auto& row : b.rows) measure(row);
    std::string text = RowText(b.header, widths);
    for (const auto& row : b.rows) text += RowText(row, widths);
    return text + "\n";
  }
  std::string operator()(const CaptionedFigure& b) const {
    if (!b.svg) return (*this)(Paragraph{MissingFigure(b)});
    return core::PrintableText(fmt::format("[figures/{}.svg] {}. {}", b.figure.name(),
                                           b.figure.title(), b.caption)) +
           "\n\n";
  }
  std::string operator()(const VideoLink& b) const {
    return core::PrintableText(fmt::format("[{}] {}", b.path, b.caption)) + "\n\n";
  }
};

std::string TextOf(const Blocks& blocks) {
  std::string text;
  for (const Block& block : blocks) text += std::visit(BlockText{}, block);
  return text;
}

}  // namespace

std::string ToPlainText(const Document& document) {
  std::string text = Underlined(document.title, '=') + TextOf(document.head.text);
  if (document.head.picture) text += TextOf({Paragraph{document.head.picture->caption}});
  text += TextOf(document.head.below);
  for (const Chapter& chapter : document.chapters)
    text += Underlined(chapter.title, '-') + TextOf(chapter.blocks);
  if (!document.not_shown.empty())
    text += Underlined("Not shown", '-') + TextOf({BulletList{document.not_shown}});
  text.pop_back();  // the empty line at the end
  return text;
}

}  // namespace scoria::analysis
