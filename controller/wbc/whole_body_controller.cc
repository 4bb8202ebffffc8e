// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/whole_body_controller.h"

#include "controller/wbc/inverse_dynamics.h"
#include "controller/wbc/tsid.h"

namespace scoria::controller {

std::unique_ptr<WholeBodyController> MakeWholeBodyController(const WbcParams& params,
                                                             const core::RobotDescription& robot) {
  struct Visitor {
    const core::RobotDescription& robot;
    std::unique_ptr<WholeBodyController> operator()(const TsidParams& p) const {
      return std::make_unique<Tsid>(p, robot);
    }
    std::unique_ptr<WholeBodyController> operator()(const InverseDynamicsParams& p) const {
      return std::make_unique<InverseDynamics>(p, robot);
    }
  };
  return std::visit(Visitor{robot}, params);
}

}  // namespace scoria::controller
