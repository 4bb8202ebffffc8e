// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/report.h"

#include <fmt/format.h>

#include "analysis/report/html.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/plain_text.h"
#include "analysis/report/sections/head.h"
#include "analysis/report/sections/sections.h"
#include "core/files.h"
#include "core/folder_lock.h"

namespace scoria::analysis {

namespace fs = std::filesystem;

Document ComposeReport(const ReportInput& input) {
  Document document;
  document.title = input.results.name;
  document.head = BuildHead(input);
  std::vector<Section> sections;
  if (!input.results.logs.empty()) sections = FieldSections();
  for (const Section& section : AllSections()) sections.push_back(section);
  for (const Section& section : sections) {
    if (const auto reason = section.why_not(input)) {
      document.not_shown.push_back(fmt::format("{}, because {}.", section.title, *reason));
    } else {
      document.chapters.push_back({section.key, section.title, section.build(input)});
    }
  }
  return document;
}

fs::path WriteReport(const fs::path& folder, const std::optional<ReportPicture>& picture,
                     const Metrics& metrics, const TestGoal& goal) {
  return WriteReport(MakeReportInput(folder, LoadResults(folder), picture, metrics, goal),
                     folder / "report");
}

fs::path WriteReport(const ReportInput& input, const fs::path& out) {
  const fs::path figures = out / "figures";
  const core::FolderLock lock(out);
  core::CreateFolders(figures);
  const Document document = DrawFigures(ComposeReport(input), figures);
  fs::path page = out / "report.html";
  core::WriteText(page, ToHtml(document));
  core::WriteText(out / "report.txt", ToPlainText(document));
  WriteMetricFiles(input, out);
  return page;
}

}  // namespace scoria::analysis
