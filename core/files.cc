// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/hash.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

/// Writes `text` to an open file and on to the disk. @returns errno, 0 for success.
int WriteToDisk(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = write(file, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  const bool kept = fsync(file) == 0 || errno == EINVAL;  // a pipe has no disk behind it
  return kept ? 0 : errno;
}

}  // namespace

std::string ErrorText(int error) {
  std::string text = std::generic_category().message(error);
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

FileError::FileError(const fs::path& file, std::string_view what, int error)
    : std::runtime_error(error == 0
                             ? fmt::format("{}: {}", file.string(), what)
                             : fmt::format("{}: {}: {}", file.string(), what, ErrorText(error))) {}

std::string ReadText(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void WriteText(const fs::path& path, std::string_view text) {
  const std::string part = path.string() + ".part";
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int error = file < 0 ? errno : WriteToDisk(file, text);
  if (file >= 0 && close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(part.c_str());
  throw FileError(path, "cannot write", error);
}

void CreateFolders(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path, "cannot create the folder", error.value());
}

std::optional<std::uint64_t> HashFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  Hash64 hash;
  std::string block(1 << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0)
    hash.Add(std::string_view(block).substr(0, static_cast<std::size_t>(in.gcount())));
  if (in.bad()) return std::nullopt;
  return hash.value();
}

std::string FileNameOf(const std::string& text) {
  constexpr std::size_t kLongest = 80;  // several of them and a hash make a name of 255 bytes
  const auto unwelcome = [](unsigned char c) {
    return (std::isalnum(c) == 0 || c > 127) && c != '.' && c != '-' && c != '_';
  };
  std::string name = text.substr(0, kLongest);
  std::replace_if(name.begin(), name.end(), unwelcome, '_');
  if (name.starts_with('.') || name.starts_with('-')) name[0] = '_';
  if (name == text && !name.empty()) return name;
  Hash64 hash;
  hash.Add(text);
  return fmt::format("{}-{:08x}", name, hash.value() & 0xffffffffu);
}

}  // namespace scoria::core
