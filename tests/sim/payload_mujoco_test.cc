// SPDX-License-Identifier: BSD-3-Clause
// The robot with payloads against MuJoCo, which joins the bodies on its own.
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "sim/payload.h"
#include "sim/sliding_payload.h"
#include "tests/support/mujoco.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double kGravity = 9.81;

/// v = T v_mujoco.
Mat18 VelocityMap(const RobotState& s) {
  Mat18 T = Mat18::Identity();
  T.block<3, 3>(3, 3) = s.R_WB;
  return T;
}

TEST(PayloadAgainstMujoco, MassMatrixAndBias) {
  const PayloadParams box{"box", 3.0, {0.05, 0.1, 0.12}, {0.3, -0.5, 1.1}, {0.2, 0.1, 0.3}};
  const PayloadParams given{"given",          1.2,          {-0.1, -0.05, 0.2},
                            {-0.7, 0.2, 0.4}, Vec3::Zero(), {0.02, 0.03, 0.04}};
  const PayloadParams point{"point", 0.5, {0.2, 0.0, 0.1}};
  test::MujocoModel mujoco(test::Go2(),
                           {.gravity_mps2 = kGravity, .payloads = {box, given, point}});
  core::WholeBodyModel model(test::Go2(), kGravity);
  const std::vector<SpatialInertia> bodies = {ToInertia(box), ToInertia(given), ToInertia(point)};
  model.SetParameters({AddBodies(model.parameters().trunk, bodies)});
  core::WholeBody wb;
  core::Rng rng{22, 0, core::Stream::kSensor};
  for (int trial = 0; trial < 50; ++trial) {
    const RobotState s = test::RandomState(rng);
    mujoco.Set(s);
    model.Calc(s, wb);
    const Mat18 T = VelocityMap(s);
    RowMajor H(18, 18);
    mj_fullM(mujoco.model.get(), H.data(), mujoco.data->qM);
    EXPECT_LT((T.transpose() * AssembleMassMatrix(wb) * T - H).lpNorm<Eigen::Infinity>(), 1e-6)
        << trial;
    const Eigen::Map<const Vec18> h(mujoco.data->qfrc_bias);
    EXPECT_LT((T.transpose() * AssembleBias(wb) - h).lpNorm<Eigen::Infinity>(),
              1e-6 * (1.0 + h.norm()))
        << trial;
  }
}

// In a step so short that nothing changes within it.
TEST(PayloadAgainstMujoco, AccelerationsWithASlidingPayload) {
  const SlidingPayloadParams params{"block", 2.0, {0.05, 0.02, 0.1}, {0.3, 1.0, 0.2}, 300.0, 5.0};
  test::MujocoModel mujoco(test::Go2(), {.gravity_mps2 = kGravity, .sliding = params});
  core::WholeBodyModel model(test::Go2(), kGravity);
  core::WholeBody wb;
  core::Rng rng{23, 0, core::Stream::kSensor};
  constexpr double kShort_s = 1e-8, kLong_s = 0.05;
  for (int trial = 0; trial < 20; ++trial) {
    const RobotState s = test::RandomState(rng);
    SlidingPayload slide(params, {0.0, 0.0, -kGravity});
    slide.Kick(s, Vec6::Constant(0.3));
    (void)slide.Step(s, Vec6::Constant(-0.2), kLong_s);  // anywhere but at rest
    mujoco.data->qpos[19] = slide.x_m();
    mujoco.data->qvel[18] = slide.rate_mps();
    mujoco.Set(s);

    model.Calc(s, wb);
    slide.AddTo(wb, kShort_s);
    const Vec18 a = AssembleMassMatrix(wb).ldlt().solve(-AssembleBias(wb));
    const Eigen::Map<const Vec18> expected(mujoco.data->qacc);
    EXPECT_LT((a - VelocityMap(s) * expected).norm(), 1e-6 * expected.norm()) << trial;
    const double before_mps = slide.rate_mps();
    (void)slide.Step(s, a.head<6>() * kShort_s, kShort_s);
    // 1e-8 m/s out of 1 m/s: what is left of the digits
    EXPECT_NEAR((slide.rate_mps() - before_mps) / kShort_s, mujoco.data->qacc[18],
                1e-5 * expected.norm())
        << trial;
  }
}

}  // namespace
}  // namespace scoria::sim
