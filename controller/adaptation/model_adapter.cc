// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/model_adapter.h"

#include "controller/adaptation/kf.h"
#include "controller/adaptation/kf_plus.h"
#include "controller/adaptation/rls.h"

namespace scoria::controller {
namespace {

/// Acts on the nominal model, or on what it is left with.
class NoAdaptation final : public ModelAdapter {
 public:
  NoAdaptation(const core::RobotDescription& robot, double gravity_mps2) {
    out_.parameters = core::WholeBodyModel(robot, gravity_mps2).parameters();
    out_.tared = true;
    out_.quality = 1.0;
  }

  const Adaptation& Update(const AdapterInput&) noexcept override { return out_; }
  void Continue(const core::ModelParameters& in_use) noexcept override { out_.parameters = in_use; }
  std::unique_ptr<ModelAdapter> Clone() const override {
    return std::make_unique<NoAdaptation>(*this);
  }

 private:
  Adaptation out_;
};

}  // namespace

std::unique_ptr<ModelAdapter> MakeModelAdapter(const AdapterParams& params,
                                               const core::RobotDescription& robot,
                                               double gravity_mps2,
                                               const ObserverParams& observer) {
  struct Maker {
    const core::RobotDescription& robot;
    double gravity_mps2;
    const ObserverParams& observer;
    std::unique_ptr<ModelAdapter> operator()(const NoAdaptationParams&) const {
      return std::make_unique<NoAdaptation>(robot, gravity_mps2);
    }
    std::unique_ptr<ModelAdapter> operator()(const AdaptationKfParams& p) const {
      return std::make_unique<AdaptationKf>(p, robot, gravity_mps2);
    }
    std::unique_ptr<ModelAdapter> operator()(const RlsParams& p) const {
      return std::make_unique<RecursiveLeastSquares>(p, robot, gravity_mps2, observer);
    }
    std::unique_ptr<ModelAdapter> operator()(const KfPlusParams& p) const {
      return std::make_unique<AdaptationKfPlus>(p, robot, gravity_mps2, observer);
    }
  };
  return std::visit(Maker{robot, gravity_mps2, observer}, params);
}

}  // namespace scoria::controller
