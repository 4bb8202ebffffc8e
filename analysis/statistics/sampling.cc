// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/sampling.h"

#include <numeric>
#include <utility>

#include <boost/random/sobol.hpp>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

core::Rng MakeRng(std::uint64_t seed) { return {seed, 3, core::Stream::kBootstrap}; }

}  // namespace

std::vector<UnitPoint> SampleSobol(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  using Engine = boost::random::sobol_engine<std::uint32_t, 32>;
  core::Rng rng = MakeRng(seed);
  std::vector<std::uint32_t> shifts;
  for (std::size_t k = 0; k < dimensions; ++k) shifts.push_back(rng.NextU32());
  Engine engine(dimensions);
  std::vector<UnitPoint> sample(points);
  for (std::size_t i = 0; i < points; ++i) {
    // The engine leaves out the first point, which is zero.
    for (const std::uint32_t shift : shifts)
      sample[i].push_back(((i == 0 ? 0 : engine()) ^ shift) * 0x1.0p-32);
  }
  return sample;
}

std::vector<UnitPoint> SampleLatinHypercube(std::size_t points, std::size_t dimensions,
                                            std::uint64_t seed) {
  core::Rng rng = MakeRng(seed);
  std::vector<UnitPoint> sample(points, UnitPoint(dimensions));
  std::vector<std::size_t> order(points);
  for (std::size_t k = 0; k < dimensions; ++k) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = points; i > 1; --i)  // Fisher and Yates
      std::swap(order[i - 1],
                order[static_cast<std::size_t>(rng.NextUniform() * static_cast<double>(i))]);
    for (std::size_t i = 0; i < points; ++i) {
      sample[i][k] =
          (static_cast<double>(order[i]) + rng.NextUniform()) / static_cast<double>(points);
    }
  }
  return sample;
}

}  // namespace scoria::analysis
