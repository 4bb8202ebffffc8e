// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "controller/controller.h"

namespace scoria::app {

/// The friction of all of the ground is scaled.
struct FrictionScale {
  double factor = 1.0;
};

/// The torque limits of all motors are scaled.
struct TorqueLimitScale {
  double factor = 1.0;
};

/// Everything that the trunk carries is taken off, a sliding payload too, and what was still to be
/// added stays away.
struct PayloadOff {};

/// The truth in place of what these stages find, until another of these says otherwise.
struct TruthFor {
  bool state = false;    // the estimated state
  bool contact = false;  // the fused contact
  bool model = false;    // the adapted mass and centre of mass
  bool ground = false;   // the plane through the last footholds
};

/// What a study changes in an episode from its next step on; a whole set of parameters changes the
/// controller. Nothing is drawn from a random stream, so an intervention that changes nothing
/// leaves the bits alone.
using Intervention = std::variant<FrictionScale, TorqueLimitScale, PayloadOff, TruthFor,
                                  controller::ControllerParams>;

/// What it does, as the detail of an event.
[[nodiscard]] std::string Describe(const Intervention& intervention);

}  // namespace scoria::app
