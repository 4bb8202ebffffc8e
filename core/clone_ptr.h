// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace scoria::core {

/// Owns a T as unique_ptr does, and copies it when its owner is copied: by T::Clone() where T is an
/// interface, else by T's copy constructor. A class that owns its parts so needs no copy
/// constructor of its own. Const access gives a const T.
template <class T>
class ClonePtr {
 public:
  ClonePtr() noexcept = default;
  template <class U>
  requires std::is_convertible_v<std::unique_ptr<U>, std::unique_ptr<T>> ClonePtr(
      std::unique_ptr<U> owned)
  noexcept : owned_(std::move(owned)) {}
  ClonePtr(const ClonePtr& other) : owned_(Copy(other.owned_.get())) {}
  ClonePtr(ClonePtr&& other) noexcept = default;
  ClonePtr& operator=(ClonePtr other) noexcept {
    owned_ = std::move(other.owned_);
    return *this;
  }

  [[nodiscard]] T& operator*() noexcept { return *owned_; }
  [[nodiscard]] const T& operator*() const noexcept { return *owned_; }
  [[nodiscard]] T* operator->() noexcept { return owned_.get(); }
  [[nodiscard]] const T* operator->() const noexcept { return owned_.get(); }
  [[nodiscard]] explicit operator bool() const noexcept { return owned_ != nullptr; }

 private:
  [[nodiscard]] static std::unique_ptr<T> Copy(const T* from) {
    if (from == nullptr) return nullptr;
    if constexpr (std::is_abstract_v<T>) {
      return from->Clone();
    } else {
      return std::make_unique<T>(*from);
    }
  }

  std::unique_ptr<T> owned_;
};

}  // namespace scoria::core
