// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <system_error>

#include <CLI/CLI.hpp>

#include "app/cli/exit_codes.h"
#include "app/commands.h"
#include "app/version.h"
#include "core/files.h"

namespace {

using scoria::app::kBadInput, scoria::app::kFileError, scoria::app::kOk;

/// Standard error may be a file on a full disk: no exception then.
int Fail(const char* what, int code) {
  std::fputs(what, stderr);
  std::fputc('\n', stderr);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "scoria: walks quadrupeds over rough ground in simulation and compares their controllers"};
  app.set_version_flag("--version", scoria::app::kVersion);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 a check failed, logs differ or the robot did not walk; 2 wrong "
      "input;\n"
      "3 interrupted or unfinished; 4 a file or the disk refused.");
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, not the end
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // quiet: what fails is told in our own words
  int exit_code = 0;
  scoria::app::AddCommands(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kOk : kBadInput;
  } catch (const scoria::core::FileError& e) {
    return Fail(e.what(), kFileError);
  } catch (const std::filesystem::filesystem_error& e) {
    return Fail(scoria::core::FileError(e.path1(), "refused", e.code().value()).what(), kFileError);
  } catch (const std::system_error& e) {  // the terminal or a pipe
    return Fail(e.what(), kFileError);
  } catch (const std::exception& e) {
    return Fail(e.what(), kBadInput);
  }
  return exit_code;
}
