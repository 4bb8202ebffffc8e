// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/program.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::test {
namespace {

int CodeOf(int status) { return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status); }

pid_t Start(const std::vector<std::string>& arguments, const std::string& output,
            const ProgramOptions& options) {
  const pid_t process = fork();
  if (process != 0) return process;
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
  if (options.largest_file > 0) {
    const rlimit limit{options.largest_file, options.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::string program = SCORIA_PROGRAM;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

ProgramEnd RunScoria(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  const TemporaryFolder folder;
  const std::string output = (folder.path() / "output.txt").string();
  const pid_t process = Start(arguments, output, options);
  ProgramEnd end;
  int status = 0;
  rusage usage{};
  constexpr std::chrono::milliseconds kPause(5);
  const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(options.patience_s);
  while (wait4(process, &status, WNOHANG, &usage) == 0) {
    if (!end.hung && std::chrono::steady_clock::now() > last) {
      end.hung = true;
      kill(process, SIGKILL);
    }
    std::this_thread::sleep_for(kPause);
  }
  end.code = CodeOf(status);
  end.peak_kB = usage.ru_maxrss;
  end.output = core::ReadText(output);
  return end;
}

pid_t StartScoria(const std::vector<std::string>& arguments) {
  return Start(arguments, "/dev/null", {});
}

int WaitFor(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return CodeOf(status);
}

std::vector<pid_t> ChildrenOf(pid_t process) {
  std::ifstream in(fmt::format("/proc/{0}/task/{0}/children", process));
  std::vector<pid_t> children;
  for (pid_t child = 0; in >> child;) children.push_back(child);
  return children;
}

}  // namespace scoria::test
