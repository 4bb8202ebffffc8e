// SPDX-License-Identifier: BSD-3-Clause
// The filter against the outputs of published implementations; the data's README tells the
// protocol.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "controller/estimation/inekf.h"
#include "core/math/se3k.h"
#include "core/math/so3.h"

namespace scoria::controller {
namespace {

namespace fs = std::filesystem;
using Index = InekfIndex;
using Json = nlohmann::json;
using Eigen::MatrixXd;
using Rows = std::vector<std::vector<double>>;

class InekfReference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SCORIA_REFERENCE_DATA");
    if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
    folder_ = fs::path(data) / "inekf";
  }
  fs::path folder_;
};

Json ReadJson(const fs::path& path) {
  std::ifstream in(path);
  return Json::parse(in);
}

/// Lines of numbers below one line of names; their length may differ.
Rows ReadCsv(const fs::path& path) {
  std::ifstream in(path);
  Rows rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<double>& row = rows.emplace_back();
    const char* at = line.c_str();
    for (char* end = nullptr;; at = end + 1) {
      row.push_back(std::strtod(at, &end));
      if (*end != ',') break;
    }
  }
  return rows;
}

std::string Text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

MatrixXd ToMatrix(const Json& j) {
  MatrixXd M(j.size(), j.at(0).size());
  for (Eigen::Index r = 0; r < M.rows(); ++r) {
    for (Eigen::Index c = 0; c < M.cols(); ++c)
      M(r, c) = j[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].get<double>();
  }
  return M;
}

Vec3 ToVec3(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

Vec3 At(const std::vector<double>& row, std::size_t i) {
  return {row.at(i), row.at(i + 1), row.at(i + 2)};
}

/// The data's order of the error: rotation, velocity, position, feet in the state, biases.
std::vector<int> DataOrder(const LegArray<bool>& in_state) {
  std::vector<int> order;
  const auto add = [&](int from) {
    for (int i = 0; i < 3; ++i) order.push_back(from + i);
  };
  for (const int from : {Index::kRotation, Index::kVelocity, Index::kPosition}) add(from);
  for (const Leg leg : kLegs) {
    if (in_state[leg]) add(Index::Foot(leg));
  }
  for (const int from : {Index::kGyroBias, Index::kAccelBias}) add(from);
  return order;
}

/// max |a_ij − b_ij| / √(b_ii b_jj).
double NormalisedDifference(const MatrixXd& a, const MatrixXd& b) {
  EXPECT_TRUE(a.allFinite());
  EXPECT_EQ(a.rows(), b.rows());
  if (a.rows() != b.rows()) return HUGE_VAL;
  const Eigen::VectorXd scale = b.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (a - b) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

/// Largest deviations met.
struct Deviation {
  double state = 0.0, covariance = 0.0;
  void AddState(double d) { state = std::isnan(d) ? HUGE_VAL : std::max(state, d); }
  void AddCovariance(double d) { covariance = std::isnan(d) ? HUGE_VAL : std::max(covariance, d); }
};

InekfState ToState(const Json& j) {
  InekfState x;
  x.R_WS = ToMatrix(j.at("R"));
  x.v_WS = ToVec3(j.at("v"));
  x.p_WS = ToVec3(j.at("p"));
  x.gyro_bias_S = ToVec3(j.at("bg"));
  x.accel_bias_S = ToVec3(j.at("ba"));
  for (const auto& [key, value] : j.at("d").items()) {
    const Leg leg = kLegs.at(static_cast<std::size_t>(std::stoi(key)));
    x.in_state[leg] = true;
    x.p_WF[leg] = ToVec3(value);
  }
  return x;
}

double StateDifference(const InekfState& a, const InekfState& b) {
  EXPECT_TRUE(a.R_WS.allFinite());
  EXPECT_EQ(a.in_state, b.in_state);
  double d = (a.R_WS - b.R_WS).cwiseAbs().maxCoeff();
  const auto add = [&](const Vec3& u, const Vec3& v) {
    EXPECT_TRUE(u.allFinite());
    d = std::max(d, (u - v).cwiseAbs().maxCoeff());
  };
  add(a.v_WS, b.v_WS);
  add(a.p_WS, b.p_WS);
  add(a.gyro_bias_S, b.gyro_bias_S);
  add(a.accel_bias_S, b.accel_bias_S);
  for (const Leg leg : kLegs) add(a.p_WF[leg], b.p_WF[leg]);
  return d;
}

TEST_F(InekfReference, LieVectors) {
  const Json data = ReadJson(folder_ / "lie_vectors.json");
  EXPECT_GT(data.at("cases").size(), 0U);
  double worst = 0.0;
  for (const Json& c : data.at("cases")) {
    const Vec3 w = ToVec3(c.at("w"));
    const core::GammaSo3 gamma(w);
    for (int m = 0; m <= 3; ++m) {
      const MatrixXd expected = ToMatrix(c.at("Gamma" + std::to_string(m)));
      worst = std::max(worst, (gamma(m) - expected).cwiseAbs().maxCoeff());
    }
    Mat3 xi, expected;  // the data's rows are the columns
    xi = ToMatrix(c.at("xi_vecs")).transpose();
    expected = ToMatrix(c.at("Exp_SEK3_cols")).transpose();
    worst = std::max(worst, (core::ExpSek3<3>(w, xi).x - expected).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-13);
  RecordProperty("worst", Text(worst));
}

void RunStep(const Json& c, Inekf& filter) {
  if (c.at("type") == "propagate") {
    InekfNoise noise;
    noise.gyro = ToMatrix(c.at("Qg"));
    noise.accel = ToMatrix(c.at("Qa"));
    noise.contact = ToMatrix(c.at("Qc"));
    noise.gyro_bias = std::pow(c.at("sbg").get<double>(), 2) * Mat3::Identity();
    noise.accel_bias = std::pow(c.at("sba").get<double>(), 2) * Mat3::Identity();
    filter.set_noise(noise);
    const auto sample = c.at("imu").get<std::vector<double>>();
    const Vec3 w_S = At(sample, 0), a_S = At(sample, 3);
    EXPECT_EQ(filter.Predict(a_S, w_S, c.at("dt")), InekfStatus::kOk);
    return;
  }
  LegArray<FootMeasurement> feet;
  for (const Leg leg : kLegs) {
    const auto i = static_cast<std::size_t>(leg);
    feet[leg].in_contact = c.at("contact").at(i).get<int>() != 0;
    feet[leg].p_SF_S = ToVec3(c.at("foot").at(i));
    feet[leg].cov_SF_S = ToMatrix(c.at("cov").at(i));
  }
  EXPECT_EQ(filter.Correct(feet).status, InekfStatus::kOk);
}

Deviation RunSteps(const fs::path& path, InekfModel model) {
  const Json data = ReadJson(path);
  EXPECT_GT(data.at("cases").size(), 0U);
  Deviation deviation;
  for (const Json& c : data.at("cases")) {
    const InekfState x = ToState(c.at("in"));
    const InekfState expected = ToState(c.at("out"));
    InekfCovariance P = InekfCovariance::Zero();
    const std::vector<int> order = DataOrder(x.in_state);
    P(order, order) = ToMatrix(c.at("in").at("P"));
    Inekf filter({.model = model});
    filter.Set(x, P);
    RunStep(c, filter);
    deviation.AddState(StateDifference(filter.state(), expected));
    const std::vector<int> out = DataOrder(filter.state().in_state);
    const bool defect = c.value("reference_defect", false);
    const MatrixXd expected_P = ToMatrix(defect ? c.at("P_exact") : c.at("out").at("P"));
    deviation.AddCovariance(NormalisedDifference(filter.covariance()(out, out), expected_P));
  }
  return deviation;
}

TEST_F(InekfReference, SingleStepsOfTheHeldRotationModel) {
  const Deviation d = RunSteps(folder_ / "unit_v1.json", InekfModel::kHeldRotation);
  EXPECT_LT(d.state, 1e-13);
  EXPECT_LT(d.covariance, 1e-12);
  RecordProperty("state", Text(d.state));
  RecordProperty("covariance", Text(d.covariance));
}

// The reference's mean itself is off by up to 2e-11.
TEST_F(InekfReference, SingleStepsOfTheExactModel) {
  const Deviation d = RunSteps(folder_ / "unit_v2_RI.json", InekfModel::kExact);
  EXPECT_LT(d.state, 1e-10);
  EXPECT_LT(d.covariance, 1e-12);
  RecordProperty("state", Text(d.state));
  RecordProperty("covariance", Text(d.covariance));
}

/// Input and start of one folder; foot i of the data is kLegs[i].
struct Scenario {
  Json meta;
  Rows input;
  std::size_t num_feet = 0;

  explicit Scenario(const fs::path& folder)
      : meta(ReadJson(folder / "meta.json")),
        input(ReadCsv(folder / "input.csv")),
        num_feet(meta.at("n_feet")) {}

  [[nodiscard]] Inekf Start(InekfModel model) const {
    const auto square = [](const Json& j) { return std::pow(j.get<double>(), 2); };
    const Json& density = meta.at("noise_density");
    InekfParams params;
    params.model = model;
    params.gravity_W = {0.0, 0.0, -meta.at("gravity").get<double>()};
    params.noise.gyro = square(density.at("gyro")) * Mat3::Identity();
    params.noise.accel = square(density.at("acc")) * Mat3::Identity();
    params.noise.gyro_bias = square(density.at("gyro_bias")) * Mat3::Identity();
    params.noise.accel_bias = square(density.at("acc_bias")) * Mat3::Identity();
    params.noise.contact = square(density.at("contact")) * Mat3::Identity();
    const Json& init = meta.at("init");
    const auto q = init.at("quat_wxyz").get<std::vector<double>>();
    InekfState x;
    x.R_WS = Quat(q.at(0), q.at(1), q.at(2), q.at(3)).normalized().toRotationMatrix();
    x.v_WS = ToVec3(init.at("v"));
    x.p_WS = ToVec3(init.at("p"));
    x.gyro_bias_S = ToVec3(init.at("bg"));
    x.accel_bias_S = ToVec3(init.at("ba"));
    InekfCovariance P = InekfCovariance::Zero();
    const std::vector<std::pair<const char*, int>> blocks = {{"rot", Index::kRotation},
                                                             {"vel", Index::kVelocity},
                                                             {"pos", Index::kPosition},
                                                             {"bg", Index::kGyroBias},
                                                             {"ba", Index::kAccelBias}};
    for (const auto& [name, from] : blocks)
      P.block<3, 3>(from, from) = square(init.at("std").at(name)) * Mat3::Identity();
    Inekf filter(params);
    filter.Set(x, P);
    return filter;
  }

  [[nodiscard]] LegArray<FootMeasurement> Feet(const std::vector<double>& row) const {
    LegArray<FootMeasurement> feet;
    for (std::size_t i = 0; i < num_feet; ++i) {
      FootMeasurement& foot = feet[kLegs[i]];
      foot.in_contact = row.at(7 + i) > 0.5;
      foot.p_SF_S = At(row, 7 + num_feet + 3 * i);
      if (meta.value("cov_columns", false)) {
        const Vec3 x = At(row, 7 + 4 * num_feet + 6 * i), y = At(row, 10 + 4 * num_feet + 6 * i);
        foot.cov_SF_S << x[0], x[1], x[2], x[1], y[0], y[1], x[2], y[1], y[2];
      } else {
        foot.cov_SF_S = ToMatrix(meta.at("foot_cov"));
      }
    }
    return feet;
  }
};

double StateDifference(const InekfState& x, const std::vector<double>& row, std::size_t num_feet) {
  InekfState expected;
  expected.R_WS = Quat(row.at(2), row.at(3), row.at(4), row.at(5)).toRotationMatrix();
  expected.v_WS = At(row, 6);
  expected.p_WS = At(row, 9);
  expected.gyro_bias_S = At(row, 12);
  expected.accel_bias_S = At(row, 15);
  for (std::size_t i = 0; i < num_feet; ++i) {
    const Vec3 d = At(row, 18 + 3 * i);
    expected.in_state[kLegs[i]] = !d.hasNaN();
    if (!d.hasNaN()) expected.p_WF[kLegs[i]] = d;
  }
  return StateDifference(x, expected);
}

/// P of the left-invariant error X⁻¹ X̂: Ad(X⁻¹) P Ad(X⁻¹)ᵀ.
InekfCovariance LeftInvariant(const InekfState& x, const InekfCovariance& P) {
  const Mat3 R_SW = x.R_WS.transpose();
  InekfCovariance ad = InekfCovariance::Identity();
  ad.block<3, 3>(Index::kRotation, Index::kRotation) = R_SW;
  const auto set = [&](int row, const Vec3& v_W) {
    ad.block<3, 3>(row, Index::kRotation) = -R_SW * core::Skew(v_W);
    ad.block<3, 3>(row, row) = R_SW;
  };
  set(Index::kVelocity, x.v_WS);
  set(Index::kPosition, x.p_WS);
  for (const Leg leg : kLegs) set(Index::Foot(leg), x.p_WF[leg]);
  return ad * P * ad.transpose();
}

double CovarianceDifference(const InekfState& x, const InekfCovariance& P,
                            const std::vector<double>& row) {
  const auto dim = static_cast<Eigen::Index>(row.at(3));
  MatrixXd expected(dim, dim);
  std::size_t at = 4;
  for (Eigen::Index i = 0; i < dim; ++i) {
    for (Eigen::Index j = i; j < dim; ++j) expected(i, j) = expected(j, i) = row.at(at++);
  }
  const std::vector<int> order = DataOrder(x.in_state);
  return NormalisedDifference(P(order, order), expected);
}

/// Deviations from <tag>_states.csv and <tag>_cov.csv, and from <left_tag>_cov.csv if named.
struct ScenarioDeviation {
  Deviation right, left;
  std::size_t compared = 0;
};

ScenarioDeviation RunScenario(const fs::path& folder, InekfModel model, const std::string& tag,
                              const std::string& left_tag) {
  const Scenario scenario(folder);
  const Rows states = ReadCsv(folder / (tag + "_states.csv"));
  const Rows covs = ReadCsv(folder / (tag + "_cov.csv"));
  const Rows left = left_tag.empty() ? Rows() : ReadCsv(folder / (left_tag + "_cov.csv"));
  Inekf filter = scenario.Start(model);
  ScenarioDeviation out;
  std::size_t state = 0, cov = 0, left_cov = 0;
  for (std::size_t k = 0; k < scenario.input.size(); ++k) {
    const std::vector<double>& row = scenario.input[k];
    if (k > 0) {
      const std::vector<double>& held = scenario.input[k - 1];
      EXPECT_EQ(filter.Predict(At(held, 4), At(held, 1), row[0] - held[0]), InekfStatus::kOk);
    }
    EXPECT_EQ(filter.Correct(scenario.Feet(row)).status, InekfStatus::kOk);
    const auto due = [k](const Rows& rows, std::size_t i) {
      return i < rows.size() && rows[i].at(0) == static_cast<double>(k);
    };
    const InekfState& x = filter.state();
    if (due(states, state))
      out.right.AddState(StateDifference(x, states[state++], scenario.num_feet));
    if (due(covs, cov))
      out.right.AddCovariance(CovarianceDifference(x, filter.covariance(), covs[cov++]));
    if (due(left, left_cov))
      out.left.AddCovariance(
          CovarianceDifference(x, LeftInvariant(x, filter.covariance()), left[left_cov++]));
  }
  EXPECT_EQ(state, states.size());
  EXPECT_EQ(cov, covs.size());
  EXPECT_EQ(left_cov, left.size());
  out.compared = state + cov + left_cov;
  return out;
}

TEST_F(InekfReference, WholeRuns) {
  std::size_t folders = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (!entry.is_directory()) continue;
    ++folders;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const ScenarioDeviation held =
        RunScenario(entry.path(), InekfModel::kHeldRotation, "v1_RI", "");
    EXPECT_LT(held.right.state, 1e-9);
    EXPECT_LT(held.right.covariance, 1e-8);
    const ScenarioDeviation exact = RunScenario(entry.path(), InekfModel::kExact, "v2_RI", "v2_LI");
    EXPECT_LT(exact.right.state, 1e-9);
    EXPECT_LT(exact.right.covariance, 1e-7);
    EXPECT_LT(exact.left.covariance, 1e-7);
    EXPECT_GT(held.compared + exact.compared, 100U);
    RecordProperty(name + "_held_state", Text(held.right.state));
    RecordProperty(name + "_held_covariance", Text(held.right.covariance));
    RecordProperty(name + "_exact_state", Text(exact.right.state));
    RecordProperty(name + "_exact_covariance", Text(exact.right.covariance));
    RecordProperty(name + "_exact_left_covariance", Text(exact.left.covariance));
  }
  EXPECT_GT(folders, 0U);
}

}  // namespace
}  // namespace scoria::controller
