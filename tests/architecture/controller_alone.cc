// SPDX-License-Identifier: BSD-3-Clause
// Links the controller and nothing else; links_test.cc looks at what came along.
#include "controller/controller.h"

int main() {
  return scoria::controller::NeedsTruth(scoria::controller::ControllerParams{}) ? 1 : 0;
}
