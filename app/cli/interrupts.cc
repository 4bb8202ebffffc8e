// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/interrupts.h"

#include <csignal>

namespace scoria::app {
namespace {

std::atomic<bool> g_interrupted = false;  // the only state that a signal handler may touch

}  // namespace

const std::atomic<bool>& Interrupted() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { g_interrupted = true; });
  return g_interrupted;
}

}  // namespace scoria::app
