// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/intervention.h"

#include <fmt/format.h>

namespace scoria::app {
namespace {

std::string Text(const FrictionScale& f) { return fmt::format("friction x {:g}", f.factor); }
std::string Text(const TorqueLimitScale& t) {
  return fmt::format("torque limits x {:g}", t.factor);
}
std::string Text(const PayloadOff&) { return "payloads off"; }
std::string Text(const TruthFor& t) {
  std::string stages;
  const auto add = [&](bool given, const char* stage) {
    if (given) stages += (stages.empty() ? "" : ", ") + std::string(stage);
  };
  add(t.state, "state");
  add(t.contact, "contact");
  add(t.model, "model");
  add(t.ground, "ground");
  return stages.empty() ? "truth for no stage" : "truth for " + stages;
}
std::string Text(const controller::ControllerParams&) { return "another controller"; }

}  // namespace

std::string Describe(const Intervention& intervention) {
  return std::visit([](const auto& change) { return Text(change); }, intervention);
}

}  // namespace scoria::app
