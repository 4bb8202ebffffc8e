// SPDX-License-Identifier: BSD-3-Clause
#include "app/gate/run_program.h"

#include <csignal>
#include <stdexcept>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scoria::app {

int RunProgram(const std::vector<std::string>& arguments, const std::filesystem::path& output) {
  constexpr int kNotStarted = 127, kSignalled = 128, kMode = 0644;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const std::string file = output.string();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("cannot start a process");
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kMode);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(argv.front(), argv.data());
    _exit(kNotStarted);
  }
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
  }
  return WIFSIGNALED(status) ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace scoria::app
