// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "logs/format/bytes.h"
#include "tests/logs/ros/cdr_writer.h"

/// Messages of robots, byte by byte: nothing is shared with the reader. Unitree's have a fixed
/// layout: numbers are put at the places that were measured in recordings of theirs.
namespace scoria::test {

inline constexpr std::int64_t kRecordingStart_ns = 1'764'707'760'000'000'000;
inline constexpr int kLittleEndian = 0x0001;

inline void WriteStamp(CdrWriter& out, std::int64_t time_ns, const char* frame) {
  out.U32(static_cast<std::uint64_t>(time_ns / 1'000'000'000))
      .U32(static_cast<std::uint64_t>(time_ns % 1'000'000'000))
      .Text(frame);
}

template <class T>
void Put(logs::Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

inline logs::Bytes ZeroMessage(std::size_t size) {
  logs::Bytes bytes(size);
  bytes[1] = std::byte{1};
  return bytes;
}

/// Motor i has q = 0.1 (i + 1), foot i a force of 10 (i + 1).
inline logs::Bytes LowState(std::uint32_t tick) {
  logs::Bytes bytes = ZeroMessage(1180);
  const std::array<float, 4> wxyz = {std::cos(0.1f), std::sin(0.1f), 0.0f, 0.0f};
  for (std::size_t k = 0; k < 4; ++k) Put(bytes, 28 + 4 * k, wxyz[k]);
  for (std::size_t k = 0; k < 3; ++k) Put(bytes, 44 + 4 * k, static_cast<float>(k + 1));
  Put(bytes, 56 + 8, 9.6f);
  for (std::size_t i = 0; i < 12; ++i) {
    Put(bytes, 84 + 48 * i, 0.1f * static_cast<float>(i + 1));
    Put(bytes, 88 + 48 * i, static_cast<float>(i));
    Put(bytes, 96 + 48 * i, -static_cast<float>(i));
  }
  for (std::size_t i = 0; i < 4; ++i)
    Put(bytes, 1084 + 2 * i, static_cast<std::int16_t>(10 * (i + 1)));
  Put(bytes, 1100, tick);
  Put(bytes, 1156, 28.5f);
  return bytes;
}

inline logs::Bytes LowCmd(float q) {
  logs::Bytes bytes = ZeroMessage(812);
  for (std::size_t i = 0; i < 12; ++i) {
    Put(bytes, 28 + 36 * i, q);
    Put(bytes, 28 + 36 * i + 12, 40.0f);
  }
  return bytes;
}

/// Rates are ten times the angles; there are no efforts.
inline logs::Bytes JointState(std::int64_t time_ns, const std::vector<std::string>& names,
                              const std::vector<double>& positions) {
  CdrWriter out(kLittleEndian);
  WriteStamp(out, time_ns, "");
  out.U32(names.size());
  for (const std::string& name : names) out.Text(name);
  for (const double scale : {1.0, 10.0}) {
    out.U32(positions.size());
    for (const double p : positions) out.F64(scale * p);
  }
  out.U32(0);  // no effort
  return out.bytes();
}

}  // namespace scoria::test
