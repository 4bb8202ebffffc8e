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
h1 { font-size: 1.7em; margin-bottom: 0.2em; } h2 { font-size: 1.25em; margin-top: 2em; border-bottom: 1px solid #ddd; }
table { border-collapse: collapse; font-size: 12px; display: block; overflow-x: auto; }
th, td { padding: 0.25em 0.6em; border-bottom: 1px solid #e5e5e5; text-align: left; }
td { white-space: nowrap; } th { background: #f4f4f4; vertical-align: bottom; }
figure { margin: 1.5em 0; } figure svg { max-width: 100%; height: auto; } video { max-width: 100%; }
.columns { display: grid; grid-template-columns: 1.25fr 1fr; gap: 1.6em; align-items: start; }
.columns h2 { margin-top: 0.4em; } .columns figure { margin: 0.4em 0; } .columns img { width: 100%; }
.columns li, .columns p { font-size: 14px; line-height: 1.4; margin: 0.35em 0; }
@media (max-width: 800px) { .columns { display: block; } }
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

HtmlPage::HtmlPage(const std::string& title) : title_(EscapeHtml(title)) {
  body_ = fmt::format("<h1>{}</h1>\n", title_);
}

void HtmlPage::Heading(const std::string& text) {
  body_ += fmt::format("<h2>{}</h2>\n", EscapeHtml(text));
}
void HtmlPage::Paragraph(const std::string& text) {
  body_ += fmt::format("<p>{}</p>\n", EscapeHtml(text));
}
void HtmlPage::Note(const std::string& text) {
  body_ += fmt::format("<p class=\"note\">{}</p>\n", EscapeHtml(text));
}

void HtmlPage::List(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += fmt::format("<li>{}</li>\n", EscapeHtml(item));
  body_ += "</ul>\n";
}

void HtmlPage::Table(const std::vector<std::string>& header,
                     const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table>\n<tr>";
  for (const std::string& cell : header) body_ += fmt::format("<th>{}</th>", EscapeHtml(cell));
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) body_ += fmt::format("<td>{}</td>", EscapeHtml(cell));
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlPage::InlineSvg(const std::string& svg, const std::string& title,
                         const std::string& caption) {
  const std::size_t start = svg.find("<svg");
  body_ += fmt::format(
      "<figure role=\"img\" aria-label=\"{}\">\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
      EscapeHtml(title),
      WithUniqueIds(start == std::string::npos ? svg : svg.substr(start), svgs_++),
      EscapeHtml(caption));
}

void HtmlPage::Image(const std::string& jpeg, const std::string& caption) {
  body_ += fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption>"
      "</figure>\n",
      EscapeHtml(caption), Base64(jpeg));
}

void HtmlPage::OpenColumns() { body_ += "<div class=\"columns\"><div>\n"; }
void HtmlPage::NextColumn() { body_ += "</div><div>\n"; }
void HtmlPage::CloseColumns() { body_ += "</div></div>\n"; }

void HtmlPage::Video(const std::string& path, const std::string& caption) {
  body_ += fmt::format(
      "<figure><video controls preload=\"metadata\" src=\"{0}\"></video><figcaption><a "
      "href=\"{0}\">{1}</a></figcaption></figure>\n",
      EscapeHtml(UrlOf(path)), EscapeHtml(caption));
}

std::string HtmlPage::Finish() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{}</title><style>{}</style></head>\n<body>\n{}</"
      "body></html>\n",
      title_, kStyle, body_);
}

}  // namespace scoria::analysis
