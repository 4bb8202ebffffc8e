// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/truth_alignment.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/config/field.h"
#include "core/math/angles.h"
#include "core/math/so3.h"

namespace scoria::analysis {
namespace {

nlohmann::json ToJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

std::string_view NameOf(LeverArmSource source) { return core::EnumName(source); }

}  // namespace

TruthAlignmentEstimator::TruthAlignmentEstimator(const core::RobotDescription* robot,
                                                 double gravity_mps2)
    : robot_(robot), gravity_mps2_(gravity_mps2), samples_(robot) {}

TruthAlignmentResult TruthAlignmentEstimator::Estimate() const {
  const TimeOffsetResult time = EstimateTimeOffset(samples_.samples());
  if (!time.offset) return {std::nullopt, time.refusal};
  TruthAlignment alignment;
  alignment.offset = *time.offset;
  const Vec3 p_BS = robot_ != nullptr ? robot_->p_BS : Vec3::Zero();
  for (const LeverArmSource source : {LeverArmSource::kAccelerometer, LeverArmSource::kEstimate}) {
    const auto arm =
        EstimateLeverArm(samples_.samples(), *time.offset, source, p_BS, gravity_mps2_);
    auto& found = alignment.lever_arm;
    if (arm) found = found ? Combine(*found, *arm) : *arm;
  }
  if (!alignment.lever_arm) {
    alignment.why_no_lever_arm =
        "the log has too little of accelerometer or estimate beside the truth";
  } else if (alignment.lever_arm->sigma_m.maxCoeff() > kLargestSigma_m) {
    alignment.why_no_lever_arm =
        fmt::format("not enough motion to tell it: standard errors of up to {:.3f} m",
                    alignment.lever_arm->sigma_m.maxCoeff());
    alignment.lever_arm.reset();
  }
  return {alignment, {}};
}

std::string DescribeAlignment(const TruthAlignmentResult& result) {
  if (!result.alignment) return fmt::format("truth is not aligned: {}", result.refusal);
  const TimeOffset& o = result.alignment->offset;
  const Vec3 rpy_deg =
      core::kDegreesPerRad * core::RpyFromRotation(o.R_BM) + Vec3::Zero();  // no -0
  std::string text = fmt::format(
      "truth is {:.1f} ms {} (standard error {:.1f} ms), its axes turned by roll {:.2f}, pitch "
      "{:.2f}, yaw {:.2f} deg ({:.2f}) on the trunk",
      1e3 * std::abs(o.delay_s), o.delay_s < 0.0 ? "early" : "late", 1e3 * o.sigma_s, rpy_deg.x(),
      rpy_deg.y(), rpy_deg.z(), core::kDegreesPerRad * o.sigma_BM_rad.maxCoeff());
  if (const auto& arm = result.alignment->lever_arm) {
    text += fmt::format(", lever arm {:.3f}, {:.3f}, {:.3f} m ({:.3f}, {:.3f}, {:.3f}) by the {}",
                        arm->p_BM.x(), arm->p_BM.y(), arm->p_BM.z(), arm->sigma_m.x(),
                        arm->sigma_m.y(), arm->sigma_m.z(), NameOf(arm->source));
  } else {
    text += fmt::format("; no lever arm: {}", result.alignment->why_no_lever_arm);
  }
  return text;
}

void to_json(nlohmann::json& j, const TruthAlignmentResult& result) {
  if (!result.alignment) {
    j = {{"refusal", result.refusal}};
    return;
  }
  const TimeOffset& o = result.alignment->offset;
  j = {{"delay_s", o.delay_s},
       {"delay_sigma_s", o.sigma_s},
       {"rpy_BM_rad", ToJson(core::RpyFromRotation(o.R_BM))},
       {"rotation_sigma_rad", ToJson(o.sigma_BM_rad)},
       {"unexplained_rate_share", o.left}};
  if (const auto& arm = result.alignment->lever_arm) {
    j["lever_arm"] = {{"p_BM_m", ToJson(arm->p_BM)},
                      {"sigma_m", ToJson(arm->sigma_m)},
                      {"source", NameOf(arm->source)}};
  } else {
    j["why_no_lever_arm"] = result.alignment->why_no_lever_arm;
  }
}

}  // namespace scoria::analysis
