// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/allocation_guard.h"

#include <cstddef>

namespace {
thread_local bool t_counting = false;
thread_local long t_count = 0;
[[maybe_unused]] void Count() {  // not under sanitizers
  if (t_counting) ++t_count;
}
}  // namespace

// glibc's allocator under its other names: the program's malloc family is replaced, so that nothing
// escapes. Not under sanitizers, which replace it themselves.
#ifndef SCORIA_SANITIZED
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  Count();
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  Count();
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t size) {
  Count();
  return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  Count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  Count();
  *out = __libc_memalign(alignment, size);
  return *out == nullptr ? 12 : 0;  // ENOMEM
}
}
#endif

namespace scoria::test {

bool AllocationGuard::IsArmed() {
#ifdef SCORIA_SANITIZED
  return false;
#else
  return true;
#endif
}

AllocationGuard::AllocationGuard() {
  t_count = 0;
  t_counting = true;
}
AllocationGuard::~AllocationGuard() { t_counting = false; }
long AllocationGuard::count() const { return t_count; }

}  // namespace scoria::test
