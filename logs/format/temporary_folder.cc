// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/files.h"

namespace scoria::logs {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw core::FileError("TMPDIR", "cannot use the temporary folder", error.value());
  std::string name = (parent / "scoria-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw core::FileError(parent, "cannot create a temporary folder", errno);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace scoria::logs
