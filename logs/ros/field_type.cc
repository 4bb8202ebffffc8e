// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/field_type.h"

namespace scoria::logs {
namespace {

constexpr std::array<std::string_view, 15> kNames = {
    "bool",   "int8",    "uint8",   "int16",  "uint16",  "int32", "uint32", "int64",
    "uint64", "float32", "float64", "string", "wstring", "time",  "struct"};

}  // namespace

std::string_view NameOf(FieldType type) noexcept { return kNames[static_cast<std::size_t>(type)]; }

std::optional<FieldType> PrimitiveNamed(std::string_view name) noexcept {
  if (name == "byte" || name == "char") return FieldType::kUint8;
  for (std::size_t i = 0; i < static_cast<std::size_t>(FieldType::kTime); ++i) {
    if (kNames[i] == name) return static_cast<FieldType>(i);
  }
  return std::nullopt;
}

}  // namespace scoria::logs
