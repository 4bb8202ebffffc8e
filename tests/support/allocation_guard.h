// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace scoria::test {

/// Counts heap allocations of this thread while it lives, by whatever route: new, malloc, Eigen,
/// the standard library.
class AllocationGuard {
 public:
  AllocationGuard();
  ~AllocationGuard();
  [[nodiscard]] long count() const;
  /// False in builds that cannot count.
  [[nodiscard]] static bool IsArmed();
};

}  // namespace scoria::test
