// SPDX-License-Identifier: BSD-3-Clause
#include "app/qp_sets.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "controller/qp/riccati_ipm.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using controller::OcpQp;
using controller::OcpStage;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

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
QpBenchmark SolveMpcSet(const QpSet& set, bool forward_euler, int repeats) {
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

QpBenchmark SolveWbcSet(const QpSet& set, int repeats) {
  QpBenchmark b;
  b.kind = "dense";
  b.problems = set.size();
  std::vector<double> times;
  controller::DenseQpSolver solver;
  for (int i = 0; i < set.size(); ++i) {
    const QpSet::Wbc problem = set.ReadWbc(i);
    controller::DenseSolution solution;
    times.push_back(MedianMicroseconds(
        repeats, [] {}, [&] { solver.Solve(problem.qp, solution); }));
    if (solution.status == controller::SolveStatus::kOptimal) ++b.solved;
    const double error = (solution.z - problem.z).lpNorm<Eigen::Infinity>() /
                         std::max(1.0, problem.z.lpNorm<Eigen::Infinity>());
    b.worst_error = std::max(b.worst_error, std::isfinite(error) ? error : 1e30);
    b.mean_iterations += static_cast<double>(solution.iterations) / set.size();
  }
  b.median_us = Median(times);
  b.p99_us = Median(times, 0.99);
  return b;
}

}  // namespace

QpSet::QpSet(const fs::path& file) {
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
  if (count_ <= 0 || record_ <= 0 || fs::file_size(file) < 64 + bytes ||
      (IsMpc() && d0_ > kMaxHorizon)) {
    throw std::runtime_error(fmt::format("{}: {} records of {} numbers do not fit the file",
                                         file.string(), count_, record_));
  }
  data_.resize(bytes / sizeof(double));
  in.read(reinterpret_cast<char*>(data_.data()), static_cast<std::streamsize>(bytes));
}

QpSet::Mpc QpSet::ReadMpc(int index) const {
  const double* record = data_.data() + static_cast<std::ptrdiff_t>(index) * record_;
  FieldReader fields(record);
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
  const auto u = fields.Matrix(N, 12);
  for (int k = 0; k <= N; ++k) {
    OcpStage& stage = qp.stages[static_cast<std::size_t>(k)];
    stage.Q = Q.row(k).transpose();
    stage.q = q.row(k).transpose();
    if (k == N) break;
    stage.E = A.block<3, 3>(12 * k, 6);
    stage.dt_s = A(12 * k + 3, 9);
    stage.B = B.middleRows<12>(12 * k);
    stage.b = b.row(k).transpose();
    stage.R = R.row(k).transpose();
    stage.r = r.row(k).transpose();
    for (const Leg leg : kLegs) stage.stance[leg] = stance(k, static_cast<int>(leg)) > 0.5;
    out.u[static_cast<std::size_t>(k)] = u.row(k).transpose();
  }
  return out;
}

QpSet::Wbc QpSet::ReadWbc(int index) const {
  FieldReader fields(data_.data() + static_cast<std::ptrdiff_t>(index) * record_);
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
  return out;
}

std::vector<QpBenchmark> BenchmarkQpSets(const fs::path& folder, int repeats) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(fmt::format("{}: not a folder", folder.string()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bin") files.push_back(entry.path());
  }
  if (files.empty())
    throw std::runtime_error(fmt::format("{}: holds no .bin file", folder.string()));
  std::sort(files.begin(), files.end());
  std::vector<QpBenchmark> results;
  for (const fs::path& file : files) {
    const QpSet set(file);
    const auto add = [&](QpBenchmark b) {
      b.file = file.filename().string();
      if (b.problems > 0) results.push_back(std::move(b));
    };
    if (set.IsMpc()) {
      add(SolveMpcSet(set, true, repeats));
      add(SolveMpcSet(set, false, repeats));
    } else {
      add(SolveWbcSet(set, repeats));
    }
  }
  return results;
}

}  // namespace scoria::app
