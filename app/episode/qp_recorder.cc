// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/qp_recorder.h"

#include <cerrno>
#include <stdexcept>

#include <Eigen/QR>
#include <fmt/format.h>

#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kMpcMeta = 20, kWbcMeta = 16;
constexpr int kWbcVars = 30, kMaxEqualities = 18, kMaxRows = 12 + 5 * kNumLegs;
constexpr double kNone = 1e20;

int MpcRecord(int N) {
  return kMpcMeta + 12 + N * (4 + 144 + 144 + 12) + 2 * (N + 1) * 12 + 2 * N * 12 + N * 12 +
         2 * (N + 1) * 12 + N * 24;
}
constexpr int kWbcRecord = kWbcMeta + kWbcVars * (kWbcVars + 1) + kMaxEqualities * (kWbcVars + 1) +
                           kMaxRows * (kWbcVars + 2) + 2 * kWbcVars + kWbcVars + kMaxEqualities +
                           kMaxRows + kWbcVars;

/// Appends fields in their order, matrices row by row.
class FieldWriter {
 public:
  template <class Derived>
  void Add(const Eigen::MatrixBase<Derived>& m) {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      for (Eigen::Index j = 0; j < m.cols(); ++j) data_.push_back(m(i, j));
    }
  }
  void Add(double value) { data_.push_back(value); }
  [[nodiscard]] const std::vector<double>& data() const { return data_; }

 private:
  std::vector<double> data_;
};

/// The problem of TsidProblem over z = (a, q̈, f of all feet), feet in the air at zero.
struct ReducedForm {
  RowMajor H = RowMajor::Zero(kWbcVars, kWbcVars), A = RowMajor::Zero(kMaxEqualities, kWbcVars),
           C = RowMajor::Zero(kMaxRows, kWbcVars);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(kWbcVars), b = Eigen::VectorXd::Zero(kMaxEqualities),
                  l = Eigen::VectorXd::Constant(kMaxRows, -kNone),
                  u = Eigen::VectorXd::Constant(kMaxRows, kNone),
                  z = Eigen::VectorXd::Zero(kWbcVars), of_rows = Eigen::VectorXd::Zero(kMaxRows);
  int equalities = 6, rows = 12;

  ReducedForm(const controller::TsidProblem& p, const controller::TsidSolution& s,
              bool torque_limits) {
    H.topLeftCorner<6, 6>() = p.G_BB;
    g.head<6>() = p.g_B;
    A.topLeftCorner<6, 6>() = p.H_BB;
    b.head<6>() = -p.h_B;
    z.head<6>() = s.a;
    for (const Leg leg : kLegs) AddLeg(p, s, leg, torque_limits);
  }

 private:
  void AddLeg(const controller::TsidProblem& p, const controller::TsidSolution& s, Leg leg,
              bool torque_limits) {
    constexpr double kRegularisation = 1e-8;  // of the force of a foot in the air
    const int l3 = 3 * static_cast<int>(leg), joints = 6 + l3, force = 18 + l3;
    H.block<6, 3>(0, joints) = p.G_Bl[leg];
    H.block<3, 6>(joints, 0) = p.G_Bl[leg].transpose();
    H.block<3, 3>(joints, joints) = p.G_ll[leg];
    g.segment<3>(joints) = p.g_l[leg];
    A.block<6, 3>(0, joints) = p.H_Bl[leg];
    C.block<3, 6>(l3, 0) = p.H_Bl[leg].transpose();
    C.block<3, 3>(l3, joints) = p.H_ll[leg];
    if (torque_limits) {
      l.segment<3>(l3) = p.tau_min[leg] - p.h_l[leg];
      u.segment<3>(l3) = p.tau_max[leg] - p.h_l[leg];
      of_rows.segment<3>(l3) = s.of_tau[leg];
    }
    z.segment<3>(joints) = s.qdd[leg];
    if (!p.stance[leg]) {
      H.block<3, 3>(force, force) = kRegularisation * Mat3::Identity();
      return;
    }
    for (const Leg other : kLegs) {
      const int o3 = 3 * static_cast<int>(other);
      if (p.stance[other]) H.block<3, 3>(force, 18 + o3) = p.G_ff.block<3, 3>(l3, o3);
    }
    g.segment<3>(force) = p.g_f.segment<3>(l3);
    A.block<6, 3>(0, force) = -p.J_B[leg].transpose();
    A.block<3, 6>(equalities, 0) = p.J_B[leg];
    A.block<3, 3>(equalities, joints) = p.J[leg];
    b.segment<3>(equalities) = p.a_c[leg];
    equalities += 3;
    C.block<3, 3>(l3, force) = -p.J[leg].transpose();
    C.block<5, 3>(rows, force) = p.cone[leg];
    l.segment<5>(rows) = p.cone_min[leg];
    of_rows.segment<5>(rows) = -s.of_cone[leg];
    rows += 5;
    z.segment<3>(force) = s.f[leg];
  }
};

}  // namespace

QpRecorder::File::File(const fs::path& path, std::string_view magic, std::array<int, 5> sizes)
    : path_(path), out_(path, std::ios::binary), magic_(magic), sizes_(sizes) {
  PutHeader();
  Check();
}

QpRecorder::File::~File() {
  out_.seekp(0);
  PutHeader();
}

void QpRecorder::File::PutHeader() {
  std::array<std::int32_t, 14> head{1,         count_,    sizes_[0], sizes_[1],
                                    sizes_[2], sizes_[3], sizes_[4]};
  out_.write(magic_.data(), static_cast<std::streamsize>(magic_.size()));
  out_.write(reinterpret_cast<const char*>(head.data()), sizeof head);
}

void QpRecorder::File::Check() const {
  if (!out_) throw core::FileError(path_, "cannot write", errno);
}

void QpRecorder::File::Write(const std::vector<double>& record) {
  out_.write(reinterpret_cast<const char*>(record.data()),
             static_cast<std::streamsize>(record.size() * sizeof(double)));
  Check();
  ++count_;
}

QpRecorder::QpRecorder(const fs::path& folder, const controller::ControllerParams& params)
    : horizon_(params.mpc.horizon),
      mpc_((fs::create_directories(folder), folder / "mpc.bin"), "SRBDMPC1",
           {horizon_, 12, 12, MpcRecord(horizon_), kMpcMeta}),
      wbc_(folder / "wbc.bin", "WBCQPR01",
           {kWbcVars, kMaxEqualities, kMaxRows, kWbcRecord, kWbcMeta}) {
  if (params.mpc.threaded)
    throw std::runtime_error("--save-qps: controller.mpc.threaded must be false");
  if (!std::holds_alternative<controller::TsidParams>(params.wbc))
    throw std::runtime_error("--save-qps: controller.wbc.type must be tsid");
}

QpRecorder::~QpRecorder() = default;

void QpRecorder::Record(const controller::Controller& controller,
                        const controller::ControlOutput& out) {
  if (out.mpc_updated) RecordMpc(controller.mpc());
  const controller::TsidRecord* wbc = controller.wbc().last();
  if (out.wbc_updated && wbc != nullptr) RecordWbc(*wbc);
}

void QpRecorder::RecordMpc(const controller::ConvexMpc& mpc) {
  const controller::OcpQp& qp = mpc.qp();
  const controller::OcpSolution& s = mpc.solution();
  if (!IsUsable(s.status)) return;
  FieldWriter w;
  Eigen::Matrix<double, kMpcMeta, 1> meta = Eigen::Matrix<double, kMpcMeta, 1>::Zero();
  meta[3] = qp.stages[0].dt_s;
  meta[4] = qp.friction;
  meta[5] = qp.f_min_N;
  meta[6] = qp.f_max_N;
  meta[8] = qp.start_force_N / 9.81;
  meta[9] = qp.forward_euler ? 0.0 : 1.0;
  meta[16] = CalcObjective(qp, s.u);
  w.Add(meta);
  w.Add(qp.x0);
  const auto for_stages = [&](int count, auto&& add) {
    for (int k = 0; k < count; ++k) add(static_cast<std::size_t>(k));
  };
  const int N = qp.horizon;
  for_stages(N, [&](std::size_t k) {
    for (const Leg leg : kLegs) w.Add(qp.stages[k].stance[leg] ? 1.0 : 0.0);
  });
  for_stages(N, [&](std::size_t k) {
    Mat12 A = Mat12::Identity();
    A.block<3, 3>(0, 6) = qp.stages[k].E;
    A.block<3, 3>(3, 9) = qp.stages[k].dt_s * Mat3::Identity();
    w.Add(A);
  });
  for_stages(N, [&](std::size_t k) { w.Add(qp.stages[k].B); });
  for_stages(N, [&](std::size_t k) { w.Add(qp.stages[k].b); });
  for_stages(N + 1, [&](std::size_t k) { w.Add(qp.stages[k].Q); });
  for_stages(N + 1, [&](std::size_t k) { w.Add(qp.stages[k].q); });
  for_stages(N, [&](std::size_t k) { w.Add(qp.stages[k].R); });
  for_stages(N, [&](std::size_t k) { w.Add(qp.stages[k].r); });
  for_stages(N, [&](std::size_t k) { w.Add(s.u[k]); });
  for_stages(N + 1, [&](std::size_t k) { w.Add(s.x[k]); });
  std::array<Vec12, kMaxHorizon + 1> pi;
  for (int i = N; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    pi[k] = qp.stages[k].Q.cwiseProduct(s.x[k]) + qp.stages[k].q;
    if (i < N) pi[k] += qp.stages[k].DriftTransposed(pi[k + 1]);
  }
  for_stages(N + 1, [&](std::size_t k) { w.Add(pi[k]); });
  for_stages(N, [&](std::size_t k) {
    for (const Vec6& lambda : s.lambda[k]) w.Add(lambda);
  });
  mpc_.Write(w.data());
}

void QpRecorder::RecordWbc(const controller::TsidRecord& wbc) {
  if (wbc.solution.status != controller::SolveStatus::kOptimal) return;
  const ReducedForm form(wbc.problem, wbc.solution, wbc.torque_limits);
  const Eigen::MatrixXd A = form.A.topRows(form.equalities);
  const Eigen::VectorXd slope = form.H * form.z + form.g + form.C.transpose() * form.of_rows;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(kMaxEqualities);
  y.head(form.equalities) = -A.transpose().colPivHouseholderQr().solve(slope);
  Eigen::Matrix<double, kWbcMeta, 1> meta = Eigen::Matrix<double, kWbcMeta, 1>::Zero();
  meta[2] = (form.rows - 12) / 5;
  for (const Leg leg : kLegs) meta[3] += wbc.problem.stance[leg] ? 1 << static_cast<int>(leg) : 0;
  meta[4] = form.equalities;
  meta[5] = form.rows;
  FieldWriter w;
  w.Add(meta);
  w.Add(form.H);
  w.Add(form.g);
  w.Add(form.A);
  w.Add(form.b);
  w.Add(form.C);
  w.Add(form.l);
  w.Add(form.u);
  w.Add(Eigen::VectorXd::Constant(kWbcVars, -kNone));
  w.Add(Eigen::VectorXd::Constant(kWbcVars, kNone));
  w.Add(form.z);
  w.Add(y);
  w.Add(form.of_rows);
  w.Add(Eigen::VectorXd::Zero(kWbcVars));
  wbc_.Write(w.data());
}

}  // namespace scoria::app
