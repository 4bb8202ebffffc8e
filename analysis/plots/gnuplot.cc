// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/gnuplot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/files.h"
#include "core/text.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

/// The pages of a figure and what a whole one ends with.
constexpr std::array<std::pair<const char*, const char*>, 3> kPages = {
    {{".svg", "</svg>"}, {".png", "IEND"}, {".pdf", "%%EOF"}}};

/// Whether the last bytes of a file, but for a few, are this text.
bool EndsWith(const fs::path& file, const std::string& text) {
  constexpr std::size_t kTail = 32;  // newlines, the checksum of a PNG
  const std::string content = core::ReadText(file);
  return content.find(text, content.size() - std::min(content.size(), kTail)) != std::string::npos;
}

std::string ShellQuoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

Figure::Figure(std::string name, std::string title, int width_px, int height_px)
    : name_(std::move(name)), title_(std::move(title)), width_px_(width_px), height_px_(height_px) {
  Line("set border 3; set tics out nomirror");
  Line("set grid lc rgb '#dddddd' lt 1 lw 0.5");
}

void Figure::Data(const std::string& name, const std::vector<std::vector<double>>& rows) {
  data_ += fmt::format("${} << EOD\n", name);
  for (const auto& row : rows) {
    for (const double value : row)
      data_ += !std::isfinite(value) ? "NaN " : fmt::format("{:.9g} ", value);
    data_ += "\n";
  }
  data_ += "EOD\n";
}

std::string Figure::Script() const {
  constexpr const char* kFont = "font 'DejaVu Sans,11' enhanced rounded";
  const double width_in = width_px_ / 96.0, height_in = height_px_ / 96.0;
  std::string script =
      fmt::format("# gnuplot script of this figure: gnuplot {}.gp\n{}", name_, data_);
  const auto page = [&](const std::string& terminal, const char* extension) {
    script += fmt::format("set terminal {}\nset output '{}.{}'\n{}unset output\nreset\n", terminal,
                          name_, extension, script_);
  };
  page(fmt::format("svg size {},{} {} background rgb 'white'", width_px_, height_px_, kFont),
       "svg");
  page(fmt::format("pngcairo size {},{} {}", width_px_, height_px_, kFont), "png");
  page(fmt::format("pdfcairo size {:.2f}in,{:.2f}in {}", width_in, height_in, kFont), "pdf");
  return script;
}

void Figure::Render(const fs::path& folder) const {
  const auto file = [&](const char* extension) { return folder / (name_ + extension); };
  for (const auto& [extension, ending] : kPages) fs::remove(file(extension));
  core::CreateFolders(folder);
  core::WriteText(file(".gp"), Script());
  // gnuplot draws in a folder of its own, whose files are taken over once they are whole.
  const fs::path draft = file(".draft");
  fs::remove_all(draft);
  core::CreateFolders(draft);
  const std::string command =
      fmt::format("cd {} && gnuplot -d {} > messages.txt 2>&1", ShellQuoted(draft.string()),
                  ShellQuoted("../" + name_ + ".gp"));
  const int status = std::system(command.c_str());
  std::string problem;
  if (status != 0) problem = "gnuplot failed: " + core::ReadText(draft / "messages.txt");
  for (const auto& [extension, ending] : kPages) {
    const fs::path drawn = draft / (name_ + extension);
    if (problem.empty() && !EndsWith(drawn, ending))
      problem = fmt::format("gnuplot wrote no whole {} file", extension);
    if (problem.empty()) fs::rename(drawn, file(extension));
  }
  fs::remove_all(draft);
  if (!problem.empty())
    throw std::runtime_error(fmt::format("{}: {}", file(".gp").string(), problem));
}

std::string Escape(const std::string& text) {
  constexpr std::size_t kLongest = 60;  // characters
  // What enhanced mode, a string in single quotes, or the number format that a tick's label is
  // would take for its own; gnuplot reads it by its octal code.
  constexpr std::string_view kSpecial = "_^@&~{}\\'%";
  std::string out;
  std::size_t characters = 0;
  bool coded = false;
  for (const char c : core::PrintableText(text)) {
    const bool starts = (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // a character of UTF-8
    if (starts && ++characters > kLongest) {
      out += "…";
      break;
    }
    const bool special = kSpecial.find(c) != std::string_view::npos;
    out += special ? fmt::format("\\{:03o}", c) : std::string(1, c);
    coded = coded || special;
  }
  // PNG and PDF show the codes as they stand where nothing else asks for enhanced mode.
  return coded ? out + "{}" : out;
}

}  // namespace scoria::analysis
