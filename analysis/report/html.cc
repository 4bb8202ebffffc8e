// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/html.h"

#include <cctype>
#include <cstring>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fmt/format.h>

#include "core/text.h"

namespace scoria::analysis {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.5 "DejaVu Sans", system-ui, sans-serif; color: #222; max-width: 1100px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.7em; margin: 0 0 0.2em; } h2 { font-size: 1.25em; margin-top: 2em; border-bottom: 1px solid #ddd; }
table { border-collapse: collapse; font-size: 12px; display: block; overflow-x: auto; }
th, td { padding: 0.25em 0.6em; border-bottom: 1px solid #e5e5e5; text-align: left; }
td { white-space: nowrap; } th { background: #f4f4f4; vertical-align: bottom; }
figure { margin: 1.5em 0; } figure svg { max-width: 100%; height: auto; } video { max-width: 100%; }
.columns { display: grid; grid-template-columns: 1.25fr 1fr; gap: 1.6em; align-items: start; }
.columns h2 { margin-top: 0.4em; } .columns figure { margin: 0.4em 0; } .columns img { width: 100%; }
.columns li, .columns p { font-size: 14px; line-height: 1.4; margin: 0.35em 0; }
header { display: flex; gap: 2em; align-items: center; justify-content: space-between; }
nav { font-size: 11px; line-height: 1.3; text-align: right; max-width: 60%; } nav a { color: #0072b2; text-decoration: none; }
@media (max-width: 800px) { .columns, header { display: block; } nav { text-align: left; max-width: none; } }
figcaption, .note { color: #555; font-size: 13px; } li { margin: 0.3em 0; }
)";

/// A relative path as a link: its bytes, with all but the harmless ones in hexadecimal.
std::string UrlOf(const std::string& path) {
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool harmless = byte < 128 && (std::isalnum(byte) != 0 || std::strchr("/._-", c));
    url += harmless ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

/// gnuplot gives the same ids to the parts of every drawing; on one page they must differ.
std::string WithUniqueIds(const std::string& svg, int number) {
  std::string out;
  const std::string prefix = fmt::format("s{}_", number);
  for (std::size_t i = 0; i < svg.size(); ++i) {
    out += svg[i];
    const auto ends = [&](const char* word) {
      return out.size() >= std::char_traits<char>::length(word) && out.ends_with(word);
    };
    if (ends(" id=\"") || ends(" id='") || ends("href=\"#") || ends("href='#") || ends("url(#"))
      out += prefix;
  }
  return out;
}

std::string Base64(const std::string& bytes) {
  using namespace boost::archive::iterators;
  using Encoder = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Encoder(bytes.begin()), Encoder(bytes.end()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

std::string RowHtml(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, EscapeHtml(cell));
  return row + "</tr>\n";
}

/// The blocks of one page, in order.
class BlockWriter {
 public:
  [[nodiscard]] std::string Write(const Blocks& blocks) {
    std::string html;
    for (const Block& block : blocks) html += std::visit(*this, block);
    return html;
  }

  std::string operator()(const Heading& b) const {
    return fmt::format("<h2>{}</h2>\n", EscapeHtml(b.text));
  }
  std::string operator()(const Paragraph& b) const {
    return fmt::format("<p>{}</p>\n", EscapeHtml(b.text));
  }
  std::string operator()(const Note& b) const {
    return fmt::format("<p class=\"note\">{}</p>\n", EscapeHtml(b.text));
  }
  std::string operator()(const BulletList& b) const {
    std::string html = "<ul>\n";
    for (const std::string& item : b.items) html += fmt::format("<li>{}</li>\n", EscapeHtml(item));
    return html + "</ul>\n";
  }
  std::string operator()(const Table& b) const {
    std::string html = "<table>\n" + RowHtml(b.header, "th");
    for (const auto& row : b.rows) html += RowHtml(row, "td");
    return html + "</table>\n";
  }
  std::string operator()(const CaptionedFigure& b) {
    if (!b.svg) return (*this)(Paragraph{MissingFigure(b)});
    const std::size_t start = b.svg->find("<svg");
    const std::string svg = start == std::string::npos ? *b.svg : b.svg->substr(start);
    return fmt::format(
        "<figure role=\"img\" aria-label=\"{}\">\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
        EscapeHtml(b.figure.title()), WithUniqueIds(svg, drawings_++), EscapeHtml(b.caption));
  }
  std::string operator()(const VideoLink& b) const {
    return fmt::format(
        "<figure><video controls preload=\"metadata\" src=\"{0}\"></video><figcaption><a "
        "href=\"{0}\">{1}</a></figcaption></figure>\n",
        EscapeHtml(UrlOf(b.path)), EscapeHtml(b.caption));
  }

 private:
  int drawings_ = 0;
};

std::string PictureHtml(const ReportPicture& picture) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption>"
      "</figure>\n",
      EscapeHtml(picture.caption), Base64(picture.jpeg));
}

std::string ContentsHtml(const Document& document) {
  std::string html;
  const auto add = [&](const std::string& key, const std::string& title) {
    html += fmt::format("{}<a href=\"#{}\">{}</a>", html.empty() ? "" : " · ", EscapeHtml(key),
                        EscapeHtml(title));
  };
  for (const Chapter& c : document.chapters) add(c.key, c.title);
  if (!document.not_shown.empty()) add("not_shown", "Not shown");
  return "<nav>" + html + "</nav>\n";
}

}  // namespace

std::string EscapeHtml(const std::string& text) {
  std::string out;
  for (const char c : core::PrintableText(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string ToHtml(const Document& document) {
  const std::string title = EscapeHtml(document.title);
  BlockWriter writer;
  std::string body =
      fmt::format("<header><h1>{}</h1>\n{}</header>\n", title, ContentsHtml(document));
  body += "<div class=\"columns\"><div>\n" + writer.Write(document.head.text) + "</div><div>\n";
  if (document.head.picture) body += PictureHtml(*document.head.picture);
  body += "</div></div>\n" + writer.Write(document.head.below);
  const auto heading = [&](const std::string& key, const std::string& text) {
    body += fmt::format("<h2 id=\"{}\">{}</h2>\n", EscapeHtml(key), EscapeHtml(text));
  };
  for (const Chapter& chapter : document.chapters) {
    heading(chapter.key, chapter.title);
    body += writer.Write(chapter.blocks);
  }
  if (!document.not_shown.empty()) {
    heading("not_shown", "Not shown");
    body += writer.Write({BulletList{document.not_shown}});
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{}</title><style>{}</style></head>\n<body>\n{}</"
      "body></html>\n",
      title, kStyle, body);
}

}  // namespace scoria::analysis
