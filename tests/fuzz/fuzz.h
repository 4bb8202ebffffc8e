// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// Fuzz targets: functions that take any bytes and must neither crash nor hang. Each NAME_fuzz.cc
/// holds one and is a program of its own in the build asan-ubsan (clang, libFuzzer); in all builds
/// a test runs it over the files of corpus/NAME.
namespace scoria::test {

void FuzzCdr(std::span<const std::uint8_t> input);
void FuzzMsg(std::span<const std::uint8_t> input);
void FuzzIdl(std::span<const std::uint8_t> input);
void FuzzMcap(std::span<const std::uint8_t> input);
void FuzzDb3(std::span<const std::uint8_t> input);
void FuzzBagMetadata(std::span<const std::uint8_t> input);
void FuzzUrdf(std::span<const std::uint8_t> input);
void FuzzYaml(std::span<const std::uint8_t> input);
void FuzzMapping(std::span<const std::uint8_t> input);

}  // namespace scoria::test

#ifdef SCORIA_FUZZ
#define SCORIA_FUZZ_TARGET(function)                                                  \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    scoria::test::function({data, size});                                             \
    return 0;                                                                         \
  }
#else
#define SCORIA_FUZZ_TARGET(function)
#endif
