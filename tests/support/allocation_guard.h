// Counts heap allocations of the calling thread while a guard object lives.
//
// Linking allocation_guard.cpp replaces malloc, calloc, realloc, aligned_alloc, memalign and posix_memalign of the
// whole executable by counting ones that forward to glibc's __libc_ functions. operator new ends in malloc, and so do
// Eigen's and the standard library's own allocations, hence nothing slips by. Under a sanitizer, which owns malloc,
// only operator new is counted (catches_malloc() says which).
// Guards nest; each counts from its own construction. Thread: counts are per thread.
#pragma once

#include <cstdint>

namespace trocar::test {

class AllocationGuard {
 public:
  AllocationGuard();
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Allocations of this thread since construction.
  std::uint64_t allocations() const;
  /// False under a sanitizer: then only operator new is seen.
  static bool catches_malloc();

 private:
  std::uint64_t start_;
};

}  // namespace trocar::test
