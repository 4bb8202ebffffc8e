// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/xacro.h"

#include <cerrno>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/config/node.h"
#include "core/files.h"
#include "core/text.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

/// An empty folder that lives as long as this.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "scoria_xacro_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw FileError(pattern, "cannot create", errno);
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// As one word of a shell's command.
std::string Quoted(const fs::path& path) {
  std::string out = "'";
  for (const char c : path.string()) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

/// The last line that says anything: a Python program's complaint itself.
std::string LastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  const std::size_t before = text.find_last_of('\n', end);
  return text.substr(before == std::string::npos ? 0 : before + 1, end - before);
}

}  // namespace

std::string ExpandXacro(const fs::path& file) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", errors = folder.path() / "errors";
  const std::string command =
      fmt::format("xacro {} > {} 2> {}", Quoted(fs::absolute(file)), Quoted(out), Quoted(errors));
  const int status = std::system(command.c_str());
  const Origin origin{file.string(), 0, 0};
  constexpr int kNotFound = 127;  // as a shell says it
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotFound) {
    throw ConfigError(origin, "urdf",
                      "is a xacro, and the program xacro, which expands it, is not installed "
                      "(pip install xacro); or expand it elsewhere: xacro IN > OUT.urdf");
  }
  if (status != 0) {
    throw ConfigError(
        origin, "urdf",
        fmt::format("the program xacro fails on it: {}", Shown(LastLine(ReadText(errors)), 300)));
  }
  return ReadText(out);
}

}  // namespace scoria::core
