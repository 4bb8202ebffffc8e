// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

namespace scoria::app {

/// Every kind of event that an episode announces.
inline constexpr std::array<std::string_view, 12> kEventKinds = {
    "placed",       "poor_ground",    "push",       "payload", "controller_change", "stuck", "fall",
    "sensor_fault", "contact_source", "supervisor", "end",     "intervention"};

}  // namespace scoria::app
