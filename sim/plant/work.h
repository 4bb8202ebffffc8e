// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "sim/plant/engine.h"
#include "sim/plant/truth.h"

namespace scoria::sim {

/// Works of the impulses of a step: with H held over it their sum is the change of kinetic energy.
[[nodiscard]] Work CalcWork(const StepInput& in, const StepResult& result,
                            std::span<const ContactPoint> contacts) noexcept;

}  // namespace scoria::sim
