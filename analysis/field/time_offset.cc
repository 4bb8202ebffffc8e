// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/time_offset.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "analysis/field/robust_fit.h"
#include "core/math/so3.h"
#include "logs/quality/statistics.h"

namespace scoria::analysis {
namespace {

constexpr int kHalf = 4;                     // samples: rates are means over twice that
constexpr double kLargestRate_radps = 20.0;  // of a trunk; beyond, markers are mixed up
constexpr int kCoarse = 4;                   // samples between delays that are tried first
constexpr int kNumLags =
    static_cast<int>(kLargestDelay_s / MotionSamples::kStep_s / kCoarse + 0.5);  // each way
constexpr std::size_t kTimeBlock = 200;                                          // samples, 1 s
constexpr std::size_t kLeastPairs = 150;   // 3 s at every fourth sample
constexpr double kLeastRate_radps = 0.02;  // gyroscopes' noise is less
constexpr double kMostLeft = 0.5;
constexpr double kApart_s = 0.1;  // from here on another delay is not of the same peak
constexpr double kSure_t = 4.0;

using Rates = std::vector<std::optional<Vec3>>;

Rates GyroRates(const std::vector<MotionSample>& samples) {
  Rates rates(samples.size());
  for (std::size_t i = kHalf; i + kHalf < samples.size(); ++i) {
    Vec3 sum = Vec3::Zero();
    bool is_whole = true;
    for (std::size_t k = i - kHalf; k <= i + kHalf && is_whole; ++k) {
      is_whole = samples[k].w_WB_B.has_value();
      const double weight = k == i - kHalf || k == i + kHalf ? 0.5 : 1.0;
      if (is_whole) sum += weight * *samples[k].w_WB_B;
    }
    if (is_whole) rates[i] = sum / (2.0 * kHalf);
  }
  return rates;
}

Rates TruthRates(const std::vector<MotionSample>& samples) {
  Rates rates(samples.size());
  for (std::size_t i = kHalf; i + kHalf < samples.size(); ++i) {
    const auto &before = samples[i - kHalf].truth, &after = samples[i + kHalf].truth;
    if (!before || !after || !samples[i].truth) continue;
    const Vec3 rate = core::LogSo3(before->R_WB.transpose() * after->R_WB) /
                      (2.0 * kHalf * MotionSamples::kStep_s);
    if (rate.norm() < kLargestRate_radps) rates[i] = rate;
  }
  return rates;
}

/// Gyroscope and truth at one delay.
struct Lag {
  int lag = 0;  // samples
  std::size_t pairs = 0;
  double squares = 0.0;          // sum of both
  Mat3 products = Mat3::Zero();  // sum of gyro truth^T
  Mat3 R_BM = Mat3::Identity();
  double left = 1.0;  // share of the squares
};

template <class Visit>
void ForEachPair(const Rates& gyro, const Rates& truth, int lag, const Visit& visit) {
  for (std::size_t i = 0; i < gyro.size(); i += kCoarse) {
    const auto j = static_cast<std::ptrdiff_t>(i) + lag;
    if (j < 0 || j >= static_cast<std::ptrdiff_t>(truth.size())) continue;
    const auto& w_M = truth[static_cast<std::size_t>(j)];
    if (gyro[i] && w_M) visit(i, *gyro[i], *w_M);
  }
}

Lag CalcLag(const Rates& gyro, const Rates& truth, int lag) {
  Lag out;
  out.lag = lag;
  ForEachPair(gyro, truth, lag, [&](std::size_t, const Vec3& w_B, const Vec3& w_M) {
    ++out.pairs;
    out.squares += w_B.squaredNorm() + w_M.squaredNorm();
    out.products += w_B * w_M.transpose();
  });
  if (out.pairs < kLeastPairs || out.squares == 0.0) return out;
  const Eigen::JacobiSVD<Mat3> svd(out.products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 signs = Vec3::Ones();
  signs.z() = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  out.R_BM = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  out.left = 1.0 - 2.0 * svd.singularValues().dot(signs) / out.squares;
  return out;
}

/// How sure it is that `best` leaves less than `rival`: mean over standard error of means over 1 s.
double SurenessOf(const Rates& gyro, const Rates& truth, const Lag& best, const Lag& rival) {
  struct Sum {
    double best = 0.0, rival = 0.0;
    std::size_t best_pairs = 0, rival_pairs = 0;
  };
  std::vector<Sum> blocks(gyro.size() / kTimeBlock + 1);
  ForEachPair(gyro, truth, best.lag, [&](std::size_t i, const Vec3& w_B, const Vec3& w_M) {
    Sum& block = blocks[i / kTimeBlock];
    block.best += (w_B - best.R_BM * w_M).squaredNorm();
    ++block.best_pairs;
  });
  ForEachPair(gyro, truth, rival.lag, [&](std::size_t i, const Vec3& w_B, const Vec3& w_M) {
    Sum& block = blocks[i / kTimeBlock];
    block.rival += (w_B - rival.R_BM * w_M).squaredNorm();
    ++block.rival_pairs;
  });
  logs::Moments gain;  // logarithms of ratios: a robot turns much now and little then
  for (const Sum& block : blocks) {
    if (block.best_pairs == 0 || block.rival_pairs == 0 || block.best * block.rival == 0.0)
      continue;
    gain.Add(std::log(block.rival / double(block.rival_pairs)) -
             std::log(block.best / double(block.best_pairs)));
  }
  if (gain.count() < 4 || gain.deviation() == 0.0) return 0.0;
  return gain.mean() / (gain.deviation() / std::sqrt(double(gain.count())));
}

/// The best of the local minima that are another peak than `best`.
std::optional<Lag> RivalOf(const std::vector<Lag>& lags, const Lag& best) {
  std::optional<Lag> rival;
  for (std::size_t k = 1; k + 1 < lags.size(); ++k) {
    const Lag& lag = lags[k];
    const bool is_minimum = lag.left <= lags[k - 1].left && lag.left <= lags[k + 1].left;
    if (!is_minimum || lag.pairs < kLeastPairs ||
        std::abs(lag.lag - best.lag) * MotionSamples::kStep_s < kApart_s)
      continue;
    if (!rival || lag.left < rival->left) rival = lag;
  }
  return rival;
}

/// The best of the delays that lie between those that were tried first.
Lag FinestNear(const Rates& gyro, const Rates& truth, const Lag& coarse) {
  Lag best = coarse;
  for (int lag = coarse.lag - kCoarse + 1; lag < coarse.lag + kCoarse; ++lag) {
    if (const Lag near = CalcLag(gyro, truth, lag); near.left < best.left) best = near;
  }
  return best;
}

std::optional<Vec3> At(const Rates& rates, double at) {
  if (at < 0.0 || at + 1.0 >= static_cast<double>(rates.size())) return std::nullopt;
  const auto before = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(before);
  if (!rates[before] || !rates[before + 1]) return std::nullopt;
  return Vec3((1.0 - share) * *rates[before] + share * *rates[before + 1]);
}

/// Gauss-Newton on delay, rotation and bias: b = [d delay, rotation vector in B, bias].
std::optional<TimeOffset> Refine(const Rates& gyro, const Rates& truth, const Lag& start) {
  constexpr int kIterations = 6;
  TimeOffset offset;
  offset.delay_s = start.lag * MotionSamples::kStep_s;
  offset.R_BM = start.R_BM;
  offset.left = start.left;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<FitSample<7>> samples;
    for (std::size_t i = 0; i < gyro.size(); ++i) {
      const double at = static_cast<double>(i) + offset.delay_s / MotionSamples::kStep_s;
      const auto now = At(truth, at), before = At(truth, at - 1.0), after = At(truth, at + 1.0);
      if (!gyro[i] || !now || !before || !after) continue;
      FitSample<7> s;
      const Vec3 w_B = offset.R_BM * *now;
      s.X.col(0) = offset.R_BM * (*after - *before) / (2.0 * MotionSamples::kStep_s);
      s.X.block<3, 3>(0, 1) = -core::Skew(w_B);
      s.X.block<3, 3>(0, 4).setIdentity();
      s.y = *gyro[i] - w_B;
      s.block = i / kTimeBlock;
      samples.push_back(s);
    }
    const auto fit = FitRobustly(samples);
    if (!fit) return std::nullopt;
    offset.delay_s += fit->b[0];
    offset.sigma_s = fit->sigma()[0];
    offset.R_BM = core::ExpSo3(fit->b.segment<3>(1)) * offset.R_BM;
    offset.sigma_BM_rad = fit->sigma().segment<3>(1);
  }
  return offset;
}

TimeOffsetResult Refused(std::string why) { return {std::nullopt, std::move(why)}; }

/// About the mean.
double DeviationOf(const Rates& rates) {
  Vec3 sum = Vec3::Zero();
  double squares = 0.0, count = 0.0;
  for (const auto& rate : rates) {
    if (rate) squares += rate->squaredNorm(), sum += *rate, ++count;
  }
  return count > 0.0 ? std::sqrt(std::max(0.0, squares - sum.squaredNorm() / count) / count) : 0.0;
}

}  // namespace

TimeOffsetResult EstimateTimeOffset(const std::vector<MotionSample>& samples) {
  const auto has = [&](const Rates& rates) {
    return std::any_of(rates.begin(), rates.end(), [](const auto& r) { return r.has_value(); });
  };
  const Rates gyro = GyroRates(samples), truth = TruthRates(samples);
  if (!has(truth)) return Refused("the log has no truth");
  if (!has(gyro)) return Refused("the log has no gyroscope to find the time of the truth by");
  const double rms_radps = DeviationOf(gyro);
  if (rms_radps < kLeastRate_radps)
    return Refused(fmt::format("the trunk hardly turns: {:.3f} rad/s rms", rms_radps));
  std::vector<Lag> lags;
  for (int k = -kNumLags; k <= kNumLags; ++k) lags.push_back(CalcLag(gyro, truth, kCoarse * k));
  const Lag best = *std::min_element(lags.begin(), lags.end(),
                                     [](const Lag& a, const Lag& b) { return a.left < b.left; });
  if (best.pairs < kLeastPairs) return Refused("gyroscope and truth share less than 3 s");
  if (best.left > kMostLeft)
    return Refused(fmt::format(
        "no delay of up to {:.0f} s makes the truth turn as the gyroscope says: {:.0f} % of the "
        "rate's square are left at the best",
        kLargestDelay_s, 100.0 * best.left));
  if (best.lag == lags.front().lag || best.lag == lags.back().lag)
    return Refused(fmt::format("the delay is beyond {:.0f} s", kLargestDelay_s));
  if (const auto rival = RivalOf(lags, best);
      rival && SurenessOf(gyro, truth, FinestNear(gyro, truth, best),
                          FinestNear(gyro, truth, *rival)) < kSure_t)
    return Refused(fmt::format(
        "delays of {:.2f} s and {:.2f} s explain the truth alike: the gait repeats itself, and "
        "there is too little other motion to tell",
        best.lag * MotionSamples::kStep_s, rival->lag * MotionSamples::kStep_s));
  const auto offset = Refine(gyro, truth, FinestNear(gyro, truth, best));
  if (!offset) return Refused("too little motion to tell delay and axes of the truth");
  return {offset, {}};
}

}  // namespace scoria::analysis
