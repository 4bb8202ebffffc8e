// SPDX-License-Identifier: BSD-3-Clause
// Bytes per second of reading messages by their definitions.
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "logs/ros/check_message.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/type_resolver.h"
#include "logs/ros/visit_leaves.h"

namespace scoria::logs {
namespace {

TypeChoice Resolve(const char* type) { return TypeResolver().Resolve({type, "cdr", "", ""}); }

void CountBytes(benchmark::State& state, std::size_t message_bytes) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(message_bytes));
}

/// A message of zeros, which is one where all is of fixed size but strings and sequences.
std::vector<std::byte> Zeros(std::size_t bytes) {
  std::vector<std::byte> message(bytes);
  message[1] = std::byte{1};
  return message;
}

void ReadAll(benchmark::State& state, const MessageType& type,
             const std::vector<std::string>& paths, const std::vector<std::byte>& message) {
  FieldReader reader(type, paths);
  for (auto _ : state) {
    double sum = 0.0;
    for (const FieldView& value : reader.Read(message)) sum += value.Double();
    benchmark::DoNotOptimize(sum);
  }
  CountBytes(state, message.size());
}

void LowStateMapping(benchmark::State& state) {
  const TypeChoice choice = Resolve("unitree_go/msg/LowState");
  std::vector<std::string> paths = {"tick", "power_v", "power_a"};
  for (int i = 0; i < 12; ++i) {
    for (const char* field : {"q", "dq", "tau_est"})
      paths.push_back(fmt::format("motor_state[{}].{}", i, field));
  }
  for (int i = 0; i < 4; ++i) {
    paths.push_back(fmt::format("imu_state.quaternion[{}]", i));
    paths.push_back(fmt::format("foot_force[{}]", i));
  }
  ReadAll(state, choice.taken()->type, paths, Zeros(1180));
}
BENCHMARK(LowStateMapping);

void QuadStateMapping(benchmark::State& state) {
  const TypeChoice choice = Resolve("interfaces/msg/QuadState");
  std::vector<std::string> paths = {"header.stamp", "pose.pose.position.x",
                                    "pose.pose.orientation.w"};
  for (int i = 0; i < 12; ++i) {
    paths.push_back(fmt::format("joint_state.position[{}]", i));
    paths.push_back(fmt::format("joint_state.velocity[{}]", i));
    paths.push_back(fmt::format("ground_contact_force[{}]", i));
  }
  ReadAll(state, choice.taken()->type, paths, Zeros(1253));
}
BENCHMARK(QuadStateMapping);

void CheckLowState(benchmark::State& state) {
  const TypeChoice choice = Resolve("unitree_go/msg/LowState");
  const std::vector<std::byte> message = Zeros(1180);
  for (auto _ : state) CheckMessage(choice.taken()->type, message);
  CountBytes(state, message.size());
}
BENCHMARK(CheckLowState);

void VisitLowState(benchmark::State& state) {
  const TypeChoice choice = Resolve("unitree_go/msg/LowState");
  const std::vector<std::byte> message = Zeros(1180);
  double sum = 0.0;
  const OnLeaf add = [&](const LeafPath&, const FieldView& view) {
    for (std::size_t i = 0; i < view.size(); ++i) sum += view.Double(i);
  };
  for (auto _ : state) VisitLeaves(choice.taken()->type, message, add);
  benchmark::DoNotOptimize(sum);
  CountBytes(state, message.size());
}
BENCHMARK(VisitLowState);

}  // namespace
}  // namespace scoria::logs

BENCHMARK_MAIN();
