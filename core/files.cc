// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace scoria::core {

std::string ReadText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void WriteText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot write", path.string()));
}

std::string FileNameOf(std::string text) {
  const auto unwelcome = [](unsigned char c) {
    return std::isalnum(c) == 0 && c != '.' && c != '-';
  };
  std::replace_if(text.begin(), text.end(), unwelcome, '_');
  return text;
}

}  // namespace scoria::core
