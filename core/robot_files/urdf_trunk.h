// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include <urdf_model/link.h>
#include <urdf_world/types.h>

namespace scoria::core {

/// The trunk of a URDF: the link that all four hips hang from, by whatever joints.
/// @pre the joints are the model's.
[[nodiscard]] urdf::LinkConstSharedPtr FindTrunk(const urdf::ModelInterface& model,
                                                 const std::array<std::string, 4>& haa_joints);

/// Nothing of a link and of what hangs from it, `without` aside, has mass or collides.
[[nodiscard]] bool IsBare(const urdf::Link& link, const urdf::Link* without);

/// Mass of a link and of what is fixed to it, `without` and what hangs from that aside.
[[nodiscard]] double FixedMass(const urdf::Link& link, const urdf::Link* without);

}  // namespace scoria::core
