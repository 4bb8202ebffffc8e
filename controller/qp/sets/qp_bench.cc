// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_bench.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "controller/qp/conversions/tsid_dense_form.h"
#include "controller/qp/sets/qp_file.h"
#include "core/math/quantile.h"
#include "core/stopwatch.h"

namespace scoria::controller {
namespace {

template <class Prepare, class Solve>
double MedianMicroseconds(int repeats, Prepare&& prepare, Solve&& solve) {
  constexpr double kUsPerS = 1e6;
  std::vector<double> times_us;
  for (int i = 0; i < repeats; ++i) {
    prepare();
    const core::Stopwatch stopwatch;
    solve();
    times_us.push_back(stopwatch.seconds() * kUsPerS);
  }
  return core::SampleQuantile(std::move(times_us), 0.5);
}

/// Sums over the problems of a set.
struct Tally {
  std::vector<double> times_us;
  int solved = 0;
  double iterations = 0.0;

  void Add(double time_us, SolveStatus status, int of_solve) {
    times_us.push_back(time_us);
    solved += status == SolveStatus::kOptimal ? 1 : 0;
    iterations += of_solve;
  }
  [[nodiscard]] int problems() const { return static_cast<int>(times_us.size()); }
  [[nodiscard]] double mean_iterations() const { return iterations / problems(); }
  [[nodiscard]] double quantile(double share) const {
    return core::SampleQuantile(times_us, share);
  }
};

constexpr double kMedian = 0.5, kP99 = 0.99;

void RaiseError(QpBenchmark& b, double error) {
  constexpr double kNone = 1e30;  // no answer at all
  b.worst_error = std::max(b.worst_error, std::isfinite(error) ? error : kNone);
}

void Judge(const OcpRecord& r, const OcpSolution& s, QpBenchmark& b) {
  const double reference = CalcObjective(r.qp, r.point.u);
  const double scale = std::max(kLeastTrackingCost, reference + CalcTrackingOffset(r.qp));
  RaiseError(b, std::abs(CalcObjective(r.qp, s.u) - reference) / scale);
  b.worst_violation = std::max(b.worst_violation, CalcViolation(r.qp, s.u));
}

void Summarise(const Tally& cold, QpBenchmark& b) {
  b.problems = cold.problems();
  if (b.problems == 0) return;
  b.solved = cold.solved;
  b.median_us = cold.quantile(kMedian);
  b.p99_us = cold.quantile(kP99);
  b.mean_iterations = cold.mean_iterations();
}

void SummariseWarm(const Tally& warm, QpBenchmark& b) {
  b.warm_problems = warm.problems();
  if (b.warm_problems == 0) return;
  b.warm_solved = warm.solved;
  b.warm_median_us = warm.quantile(kMedian);
  b.warm_p99_us = warm.quantile(kP99);
  b.warm_mean_iterations = warm.mean_iterations();
}

/// The records whose dynamics are forward Euler, or the others.
QpBenchmark SolveOcps(QpFileReader& reader, const NamedSolver<OcpSolver>& named, bool forward_euler,
                      int repeats) {
  QpBenchmark b;
  b.solver = named.name;
  b.kind = forward_euler ? "forward Euler" : "zero-order hold";
  OcpSolver& solver = *named.solver;
  Tally cold, warm;
  std::optional<OcpRecord> before;
  for (int i = 0; i < reader.size(); ++i) {
    const OcpRecord r = reader.ReadOcp(i);
    if (r.qp.forward_euler != forward_euler) continue;
    const OcpSolution* s = nullptr;
    const auto solve = [&] { s = &solver.Solve(r.qp); };
    const double cold_us = MedianMicroseconds(
        repeats, [&] { solver.Reset(); }, solve);
    cold.Add(cold_us, s->status, s->iterations);
    Judge(r, *s, b);
    const bool second_tick = i % 2 == 1;
    if (second_tick && before) {
      const auto start = [&] {
        solver.Reset();
        (void)solver.Solve(before->qp);
      };
      const double warm_us = MedianMicroseconds(repeats, start, solve);
      warm.Add(warm_us, s->status, s->iterations);
      Judge(r, *s, b);
    }
    before = r;
  }
  Summarise(cold, b);
  SummariseWarm(warm, b);
  return b;
}

/// @param solve  (record, repeats) → time in µs, status, iterations, |z − z*|.
struct Solved {
  double time_us = 0.0;
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  double error = 0.0;
};
template <class Solve>
QpBenchmark SolveRecords(QpFileReader& reader, const std::string& solver, Solve&& solve) {
  QpBenchmark b;
  b.solver = b.kind = solver;
  Tally tally;
  for (int i = 0; i < reader.size(); ++i) {
    const DenseRecord r = reader.ReadDense(i);
    const Solved solved = solve(r);
    tally.Add(solved.time_us, solved.status, solved.iterations);
    RaiseError(b, solved.error / std::max(1.0, r.point.z.lpNorm<Eigen::Infinity>()));
  }
  Summarise(tally, b);
  return b;
}

/// Of accelerations and forces.
double Distance(const TsidSolution& a, const TsidSolution& b) {
  double most = (a.a - b.a).lpNorm<Eigen::Infinity>();
  for (const Leg leg : kLegs) {
    most = std::max({most, (a.qdd[leg] - b.qdd[leg]).lpNorm<Eigen::Infinity>(),
                     (a.f[leg] - b.f[leg]).lpNorm<Eigen::Infinity>()});
  }
  return most;
}

Solved SolveTsid(TsidSolver& solver, const DenseRecord& r, int repeats) {
  const TsidLayout layout = r.layout();
  const TsidProblem problem = FromDense(r.qp, layout);
  TsidSolution s;
  const double time_us = MedianMicroseconds(
      repeats, [] {}, [&] { s = solver.Solve(problem); });
  DenseSolution reference;
  reference.z = r.point.z;
  reference.of_rows = r.point.of_rows;
  reference.of_bounds = r.point.of_bounds;
  return {time_us, s.status, s.iterations, Distance(s, FromDense(reference, problem, layout))};
}

Solved SolveDense(DenseSolver& solver, const DenseRecord& r, int repeats) {
  const DenseQpView qp = r.qp;
  std::optional<DenseSolutionView> s;
  const double time_us = MedianMicroseconds(
      repeats, [] {}, [&] { s.emplace(solver.Solve(qp)); });
  const bool answered = s->z.size() == r.point.z.size();
  return {time_us, s->status, s->iterations,
          answered ? (s->z - r.point.z).lpNorm<Eigen::Infinity>() : NAN};
}

}  // namespace

std::vector<QpBenchmark> BenchmarkQpFiles(const std::filesystem::path& folder,
                                          const QpSolvers& solvers, int repeats) {
  std::vector<QpBenchmark> results;
  for (const std::filesystem::path& file : FindQpFiles(folder)) {
    QpFileReader reader(file);
    const auto add = [&](QpBenchmark b) {
      b.file = file.filename().string();
      if (b.problems > 0) results.push_back(std::move(b));
    };
    if (reader.is_ocp()) {
      for (const auto& named : solvers.ocp) {
        for (const bool forward_euler : {true, false})
          add(SolveOcps(reader, named, forward_euler, repeats));
      }
      continue;
    }
    for (const auto& named : solvers.tsid) {
      add(SolveRecords(reader, named.name,
                       [&](const DenseRecord& r) { return SolveTsid(*named.solver, r, repeats); }));
    }
    for (const auto& named : solvers.dense) {
      add(SolveRecords(reader, named.name, [&](const DenseRecord& r) {
        return SolveDense(*named.solver, r, repeats);
      }));
    }
  }
  return results;
}

}  // namespace scoria::controller
