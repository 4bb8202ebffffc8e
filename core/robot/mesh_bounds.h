// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/math/types.h"

namespace scoria::core {

/// The box around a mesh, in its own frame, m.
struct MeshBounds {
  Vec3 low, high;
};

/// What a log keeps of a mesh file: the box around it and its convex hull, without the URDF's
/// scale, and Hash64 of its content.
struct MeshRecord {
  MeshBounds bounds{Vec3::Zero(), Vec3::Zero()};
  std::uint64_t hash = 0;
  std::vector<Vec3> hull;  // empty in logs of version 0.1: the mesh collides as its box
};
/// By the name that the URDF gives the file.
using MeshRecords = std::map<std::string, MeshRecord>;

}  // namespace scoria::core
