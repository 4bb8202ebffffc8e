// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/config/field.h"
#include "core/math/types.h"

namespace scoria::core {

/// Multiplies the fields of a configuration struct by what their dimensions (FieldRule::scale) say.
class ConfigScaler {
 public:
  explicit ConfigScaler(const Similarity& similarity) noexcept : similarity_(similarity) {}

  template <class T>
  void Field(const char* /*key*/, T& value, const FieldRule& rule = {}) const {
    Scale(value, rule);
  }
  template <class T>
  void Required(const char* key, T& value, const FieldRule& rule = {}) const {
    Field(key, value, rule);
  }

  template <class T>
  void Scale(T& value, const FieldRule& rule) const;

 private:
  template <class T>
  void ScaleItem(std::vector<T>& list, const FieldRule& rule) const {
    for (T& item : list) Scale(item, rule);
  }
  template <class T>
  void ScaleItem(std::optional<T>& value, const FieldRule& rule) const {
    if (value) Scale(*value, rule);
  }
  template <class... Ts>
  void ScaleItem(std::variant<Ts...>& value, const FieldRule& rule) const {
    std::visit([&](auto& alternative) { Scale(alternative, rule); }, value);
  }
  template <class T>
  void ScaleItem(T& /*other*/, const FieldRule& /*rule*/) const {}

  const Similarity& similarity_;
};

template <class T>
void ConfigScaler::Scale(T& value, const FieldRule& rule) const {
  if constexpr (std::is_same_v<T, double>) {
    if (rule.scale != Dimension{}) value *= similarity_.Factor(rule.scale);
  } else if constexpr (std::is_same_v<T, Vec3>) {
    for (double& item : value) Scale(item, rule);
  } else if constexpr (requires { value.Serialize(*this); }) {
    value.Serialize(*this);
  } else {
    ScaleItem(value, rule);
  }
}

/// A configuration of the Go2's size at that of another robot.
template <class T>
[[nodiscard]] T Scaled(T value, const Similarity& similarity) {
  if (!similarity.IsReference()) ConfigScaler(similarity).Scale(value, {});
  return value;
}

}  // namespace scoria::core
