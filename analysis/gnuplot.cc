// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/gnuplot.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace scoria::analysis {
namespace {

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
      data_ += std::isnan(value) ? "NaN " : fmt::format("{:.9g} ", value);
    data_ += "\n";
  }
  data_ += "EOD\n";
}

void Figure::Render(const std::filesystem::path& folder) const {
  namespace fs = std::filesystem;
  fs::create_directories(folder);
  const fs::path script = folder / (name_ + ".gp");
  const double width_in = width_px_ / 96.0, height_in = height_px_ / 96.0;
  std::ofstream out(script);
  out << "# gnuplot script of this figure: gnuplot " << name_ << ".gp\n" << data_;
  const auto page = [&](const std::string& terminal, const char* extension) {
    out << "set terminal " << terminal << "\nset output '" << name_ << "." << extension << "'\n"
        << script_ << "unset output\nreset\n";
  };
  constexpr const char* kFont = "font 'DejaVu Sans,11' enhanced rounded";
  page(fmt::format("svg size {},{} {} background rgb 'white'", width_px_, height_px_, kFont),
       "svg");
  page(fmt::format("pngcairo size {},{} {}", width_px_, height_px_, kFont), "png");
  page(fmt::format("pdfcairo size {:.2f}in,{:.2f}in {}", width_in, height_in, kFont), "pdf");
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot write", script.string()));
  const fs::path messages = folder / (name_ + ".gnuplot.txt");
  const std::string command =
      fmt::format("cd {} && gnuplot {}.gp > {}.gnuplot.txt 2>&1", ShellQuoted(folder.string()),
                  ShellQuoted(name_), ShellQuoted(name_));
  const int status = std::system(command.c_str());
  if (status != 0) {
    std::ifstream in(messages);
    std::stringstream words;
    words << in.rdbuf();
    throw std::runtime_error(fmt::format("{}: gnuplot failed: {}", script.string(), words.str()));
  }
  fs::remove(messages);
}

std::string Escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '_' || c == '^' || c == '@' || c == '&' || c == '~' || c == '{' || c == '}')
      out += '\\';
    if (c == '\'') out += '\'';
    out += c;
  }
  return out;
}

std::string ArmColour(std::size_t index) {
  constexpr std::array<const char*, 6> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                   "#cc79a7", "#e69f00", "#56b4e9"};
  return kColours[index % kColours.size()];
}

}  // namespace scoria::analysis
