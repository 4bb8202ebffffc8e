// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace scoria::analysis {

/// A plain page without outside resources. All text is escaped; SVG is embedded as it stands.
class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title);
  void Heading(const std::string& text);
  void Paragraph(const std::string& text);
  void Note(const std::string& text);
  void List(const std::vector<std::string>& items);
  void Table(const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  void InlineSvg(const std::string& svg, const std::string& title, const std::string& caption);
  /// A JPEG, embedded.
  void Image(const std::string& jpeg, const std::string& caption);
  /// What is added between these stands in two columns.
  void OpenColumns();
  void NextColumn();
  void CloseColumns();
  void Video(const std::string& path, const std::string& caption);
  [[nodiscard]] std::string Finish() const;

 private:
  std::string body_;
  std::string title_;
  int svgs_ = 0;
};

[[nodiscard]] std::string EscapeHtml(const std::string& text);

}  // namespace scoria::analysis
