// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "core/rng.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::test {

/// The Go2 of the repository, loaded once.
const core::RobotDescription& Go2();

/// Level ground, a few metres wide, at z = 0.
terrains::Heightfield FlatGround(double friction = 0.8, double size_m = 20.0);

/// A plane tilted by `slope_rad` uphill along +x.
terrains::Heightfield TiltedGround(double slope_rad, double friction);

/// Standing at the nominal height on z = 0.
RobotState StandingState();

/// A random pose and velocity with the legs away from their singularities.
RobotState RandomState(core::Rng& rng);

/// A file of the repository.
std::filesystem::path SourcePath(const std::string& relative);

/// A fresh folder below the system's temporary one, removed by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace scoria::test
