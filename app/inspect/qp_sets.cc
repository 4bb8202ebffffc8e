// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/qp_sets.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "controller/qp/riccati_ipm.h"
#include "controller/wbc/tsid_nullspace.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using controller::OcpQp;
using controller::OcpStage;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::streamoff kHeaderBytes = 64;
constexpr double kGap = 1e-6;  // relative duality gap asked of the interior point method

/// Takes the fields of a record in their order.
class FieldReader {
 public:
  explicit FieldReader(const double* data) : data_(data) {}
  Eigen::Map<const RowMajor> Matrix(Eigen::Index rows, Eigen::Index columns) {
    const double* at = data_;
    data_ += rows * columns;
    return {at, rows, columns};
  }
  Eigen::Map<const Eigen::VectorXd> Vector(Eigen::Index size) {
    const double* at = data_;
    data_ += size;
    return {at, size};
  }

 private:
  const double* data_;
};

double Median(std::vector<double> values, double share = 0.5) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

template <class Prepare, class Function>
double MedianMicroseconds(int repeats, Prepare&& prepare, Function&& function) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    const auto start = std::chrono::steady_clock::now();
    function();
    times.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
            .count());
  }
  return Median(times);
}

double Violation(const OcpQp& qp, const std::array<Vec12, kMaxHorizon>& u) {
  double worst = 0.0;
  for (int k = 0; k < qp.horizon; ++k) {
    for (const Leg leg : kLegs) {
      const Vec3 f = u[static_cast<std::size_t>(k)].segment<3>(3 * static_cast<int>(leg));
      if (!qp.stages[static_cast<std::size_t>(k)].stance[leg]) {
        worst = std::max(worst, f.cwiseAbs().maxCoeff());
        continue;
      }
      worst =
          std::max({worst, std::abs(f.x()) - qp.friction * f.z(),
                    std::abs(f.y()) - qp.friction * f.z(), qp.f_min_N - f.z(), f.z() - qp.f_max_N});
    }
  }
  return worst;
}

/// The records of a set whose dynamics are forward Euler, or the others.
QpBenchmark SolveMpcSet(QpSet& set, bool forward_euler, int repeats) {
  QpBenchmark b;
  b.kind = forward_euler ? "forward Euler" : "zero-order hold";
  std::vector<double> times, warm_times;
  controller::RiccatiIpmParams params;
  params.tolerance = kGap;
  params.max_iterations = 60;
  const auto solver = std::make_unique<controller::RiccatiIpm>(params);
  const auto before = std::make_unique<controller::RiccatiIpm>(params);
  const auto solution = std::make_unique<controller::OcpSolution>();
  double iterations = 0.0, warm_iterations = 0.0;
  const auto judge = [&](const QpSet::Mpc& problem) {
    const double reference = CalcObjective(problem.qp, problem.u);
    const double gap = std::abs(CalcObjective(problem.qp, solution->u) - reference) /
                       std::max(1e-3, reference + CalcTrackingOffset(problem.qp));
    b.worst_error = std::max(b.worst_error, std::isfinite(gap) ? gap : 1e30);
    b.worst_violation = std::max(b.worst_violation, Violation(problem.qp, solution->u));
    return solution->status == controller::SolveStatus::kOptimal ? 1 : 0;
  };
  for (int i = 0; i < set.size(); ++i) {
    const QpSet::Mpc problem = set.ReadMpc(i);
    if (problem.qp.forward_euler != forward_euler) continue;
    ++b.problems;
    times.push_back(MedianMicroseconds(
        repeats, [&] { solver->Reset(); }, [&] { solver->Solve(problem.qp, *solution); }));
    b.solved += judge(problem);
    iterations += solution->iterations;
    const bool second_tick = i % 2 == 1;
    if (second_tick) {
      warm_times.push_back(MedianMicroseconds(
          repeats, [&] { *solver = *before; }, [&] { solver->Solve(problem.qp, *solution); }));
      b.warm_solved += judge(problem);
      ++b.warm_problems;
      warm_iterations += solution->iterations;
    }
    *before = *solver;
  }
  if (b.problems == 0) return b;
  b.mean_iterations = iterations / b.problems;
  b.median_us = Median(times);
  b.p99_us = Median(times, 0.99);
  if (b.warm_problems == 0) return b;
  b.warm_mean_iterations = warm_iterations / b.warm_problems;
  b.warm_median_us = Median(warm_times);
  b.warm_p99_us = Median(warm_times, 0.99);
  return b;
}

QpBenchmark SolveWbcSet(QpSet& set, bool nullspace, int repeats) {
  QpBenchmark b;
  b.kind = nullspace ? "null space" : "dense";
  b.problems = set.size();
  std::vector<double> times;
  const auto dense = std::make_unique<controller::DenseQpSolver>();
  const auto form = std::make_unique<controller::TsidNullspace>();
  for (int i = 0; i < set.size(); ++i) {
    const QpSet::Wbc problem = set.ReadWbc(i);
    double error = 0.0;
    if (nullspace) {
      controller::TsidSolution solution;
      times.push_back(MedianMicroseconds(
          repeats, [] {}, [&] { solution = form->Solve(problem.problem, true); }));
      if (solution.status == controller::SolveStatus::kOptimal) ++b.solved;
      b.mean_iterations += static_cast<double>(solution.iterations) / set.size();
      error = (solution.a - problem.z.head<6>()).lpNorm<Eigen::Infinity>();
      for (const Leg leg : kLegs) {
        const Vec3 qdd = problem.z.segment<3>(6 + 3 * static_cast<int>(leg));
        error = std::max({error, (solution.qdd[leg] - qdd).lpNorm<Eigen::Infinity>(),
                          (solution.f[leg] - problem.f[leg]).lpNorm<Eigen::Infinity>()});
      }
    } else {
      controller::DenseSolution solution;
      times.push_back(MedianMicroseconds(
          repeats, [] {}, [&] { dense->Solve(problem.qp, solution); }));
      if (solution.status == controller::SolveStatus::kOptimal) ++b.solved;
      b.mean_iterations += static_cast<double>(solution.iterations) / set.size();
      error = (solution.z - problem.z).lpNorm<Eigen::Infinity>();
    }
    error /= std::max(1.0, problem.z.lpNorm<Eigen::Infinity>());
    b.worst_error = std::max(b.worst_error, std::isfinite(error) ? error : 1e30);
  }
  b.median_us = Median(times);
  b.p99_us = Median(times, 0.99);
  return b;
}

/// The blocks of a dense whole-body problem, z = (q̈, [τ,] f of all feet).
controller::TsidProblem ToBlocks(const controller::DenseQp& qp, int contact_mask) {
  const bool full = qp.H.rows() == 42;
  const int force_0 = full ? 30 : 18;
  controller::TsidProblem p;
  p.H_BB = qp.A.topLeftCorner<6, 6>();
  p.h_B = -qp.b.head<6>();
  p.G_BB = qp.H.topLeftCorner<6, 6>();
  p.g_B = qp.g.head<6>();
  p.G_ff = qp.H.block<12, 12>(force_0, force_0);
  p.g_f = qp.g.segment<12>(force_0);
  int contact_row = full ? 18 : 6, cone_row = full ? 0 : 12;
  const int feet = std::popcount(static_cast<unsigned>(contact_mask));
  const int rows_per_foot = (static_cast<int>(qp.C.rows()) - cone_row) / std::max(1, feet);
  for (const Leg leg : kLegs) {
    const int l = static_cast<int>(leg), joints = 6 + 3 * l, force = force_0 + 3 * l;
    p.H_Bl[leg] = qp.A.block<6, 3>(0, joints);
    p.G_Bl[leg] = qp.H.block<6, 3>(0, joints);
    p.G_ll[leg] = qp.H.block<3, 3>(joints, joints);
    p.g_l[leg] = qp.g.segment<3>(joints);
    if (full) {
      p.H_ll[leg] = qp.A.block<3, 3>(joints, joints);
      p.h_l[leg] = -qp.b.segment<3>(joints);
      p.tau_min[leg] = qp.lb.segment<3>(18 + 3 * l);
      p.tau_max[leg] = qp.ub.segment<3>(18 + 3 * l);
    } else {  // bounds on τ − h
      p.H_ll[leg] = qp.C.block<3, 3>(3 * l, joints);
      p.h_l[leg].setZero();
      p.tau_min[leg] = qp.l.segment<3>(3 * l);
      p.tau_max[leg] = qp.u.segment<3>(3 * l);
    }
    p.stance[leg] = (contact_mask >> l) % 2 == 1;
    if (!p.stance[leg]) continue;
    p.J_B[leg] = qp.A.block<3, 6>(contact_row, 0);
    p.J[leg] = qp.A.block<3, 3>(contact_row, joints);
    p.a_c[leg] = qp.b.segment<3>(contact_row);
    contact_row += 3;
    p.cone[leg].setZero();  // a fifth row that is missing says 0 >= -1
    p.cone_min[leg].setConstant(-1.0);
    for (int row = 0; row < rows_per_foot; ++row, ++cone_row) {
      const bool low = qp.l[cone_row] > -controller::DenseQp::kNone;
      const Vec3 side = qp.C.block<1, 3>(cone_row, force).transpose();
      p.cone[leg].row(row) = (low ? side : Vec3(-side)).transpose();
      p.cone_min[leg][row] = low ? qp.l[cone_row] : -qp.u[cone_row];
    }
  }
  return p;
}

}  // namespace

QpSet::QpSet(const fs::path& file) : name_(file.string()) {
  std::ifstream in(file, std::ios::binary);
  char magic[8];
  std::array<std::int32_t, 14> head{};
  in.read(magic, sizeof magic);
  in.read(reinterpret_cast<char*>(head.data()), sizeof head);
  if (!in)
    throw std::runtime_error(fmt::format("{}: cannot read a QP set's header", file.string()));
  magic_.assign(magic, sizeof magic);
  if (magic_ != "SRBDMPC1" && magic_ != "WBCQPF01" && magic_ != "WBCQPR01") {
    throw std::runtime_error(fmt::format("{}: not a QP set (magic \"{}\")", file.string(), magic_));
  }
  count_ = head[1];
  d0_ = head[2];
  d1_ = head[3];
  d2_ = head[4];
  record_ = head[5];
  meta_ = head[6];
  const auto bytes =
      static_cast<std::uintmax_t>(count_) * static_cast<std::uintmax_t>(record_) * sizeof(double);
  if (count_ <= 0 || record_ <= 0 ||
      fs::file_size(file) < static_cast<std::uintmax_t>(kHeaderBytes) + bytes ||
      (IsMpc() && d0_ > kMaxHorizon)) {
    throw std::runtime_error(fmt::format("{}: {} records of {} numbers do not fit the file",
                                         file.string(), count_, record_));
  }
  file_ = std::move(in);
  data_.resize(static_cast<std::size_t>(record_));
}

const double* QpSet::ReadRecord(int index) {
  const auto bytes = static_cast<std::streamoff>(record_) * std::streamoff{sizeof(double)};
  file_.seekg(kHeaderBytes + index * bytes);
  file_.read(reinterpret_cast<char*>(data_.data()), bytes);
  if (!file_) throw std::runtime_error(fmt::format("{}: record {} cannot be read", name_, index));
  return data_.data();
}

QpSet::Mpc QpSet::ReadMpc(int index) {
  FieldReader fields(ReadRecord(index));
  const int N = d0_;
  const auto meta = fields.Vector(meta_);
  Mpc out;
  OcpQp& qp = out.qp;
  qp.horizon = N;
  qp.friction = meta[4];
  qp.f_min_N = meta[5];
  qp.f_max_N = meta[6];
  qp.start_force_N = meta[8] * 9.81;
  qp.forward_euler = meta[9] == 0.0;
  qp.x0 = fields.Vector(12);
  const auto stance = fields.Matrix(N, 4);
  const auto A = fields.Matrix(12 * N, 12), B = fields.Matrix(12 * N, 12), b = fields.Matrix(N, 12);
  const auto Q = fields.Matrix(N + 1, 12), q = fields.Matrix(N + 1, 12), R = fields.Matrix(N, 12),
             r = fields.Matrix(N, 12);
  const auto u = fields.Matrix(N, 12), x = fields.Matrix(N + 1, 12), pi = fields.Matrix(N + 1, 12),
             lambda = fields.Matrix(N, 24);
  for (int k = 0; k <= N; ++k) {
    OcpStage& stage = qp.stages[static_cast<std::size_t>(k)];
    stage.Q = Q.row(k).transpose();
    stage.q = q.row(k).transpose();
    out.x[static_cast<std::size_t>(k)] = x.row(k).transpose();
    out.pi[static_cast<std::size_t>(k)] = pi.row(k).transpose();
    if (k == N) break;
    stage.E = A.block<3, 3>(12 * k, 6);
    stage.dt_s = A(12 * k + 3, 9);
    stage.B = B.middleRows<12>(12 * k);
    stage.b = b.row(k).transpose();
    stage.R = R.row(k).transpose();
    stage.r = r.row(k).transpose();
    for (const Leg leg : kLegs) stage.stance[leg] = stance(k, static_cast<int>(leg)) > 0.5;
    out.u[static_cast<std::size_t>(k)] = u.row(k).transpose();
    out.lambda[static_cast<std::size_t>(k)] = lambda.row(k).transpose();
  }
  return out;
}

QpSet::Wbc QpSet::ReadWbc(int index) {
  FieldReader fields(ReadRecord(index));
  const int n = d0_;
  const auto meta = fields.Vector(meta_);
  const auto equalities = static_cast<Eigen::Index>(meta[4]),
             rows = static_cast<Eigen::Index>(meta[5]);
  Wbc out;
  out.qp.H = fields.Matrix(n, n);
  out.qp.g = fields.Vector(n);
  out.qp.A = fields.Matrix(d1_, n).topRows(equalities);
  out.qp.b = fields.Vector(d1_).head(equalities);
  out.qp.C = fields.Matrix(d2_, n).topRows(rows);
  out.qp.l = fields.Vector(d2_).head(rows);
  out.qp.u = fields.Vector(d2_).head(rows);
  out.qp.lb = fields.Vector(n);
  out.qp.ub = fields.Vector(n);
  out.z = fields.Vector(n);
  out.y = fields.Vector(d1_).head(equalities);
  out.of_rows = fields.Vector(d2_).head(rows);
  out.of_bounds = fields.Vector(n);
  out.problem = ToBlocks(out.qp, static_cast<int>(meta[3]));
  for (const Leg leg : kLegs) out.f[leg] = out.z.segment<3>(n - 12 + 3 * static_cast<int>(leg));
  return out;
}

std::vector<fs::path> FindQpSets(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: not a folder", folder.string()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bin") files.push_back(entry.path());
  }
  if (files.empty())
    throw std::runtime_error(fmt::format("{}: holds no .bin file", folder.string()));
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<QpBenchmark> BenchmarkQpSets(const fs::path& folder, int repeats) {
  std::vector<QpBenchmark> results;
  for (const fs::path& file : FindQpSets(folder)) {
    QpSet set(file);
    const auto add = [&](QpBenchmark b) {
      b.file = file.filename().string();
      if (b.problems > 0) results.push_back(std::move(b));
    };
    if (set.IsMpc()) {
      add(SolveMpcSet(set, true, repeats));
      add(SolveMpcSet(set, false, repeats));
    } else {
      add(SolveWbcSet(set, true, repeats));
      add(SolveWbcSet(set, false, repeats));
    }
  }
  return results;
}

}  // namespace scoria::app
