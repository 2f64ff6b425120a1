#include "tests/support/allocation_guard.h"

#include <cerrno>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TROCAR_COUNTS_MALLOC 0
#else
#define TROCAR_COUNTS_MALLOC 1
#endif

namespace {

// Plain integers: reachable before any constructor has run and without allocating.
thread_local std::uint64_t allocation_count = 0;
thread_local int guards_alive = 0;

inline void note_allocation() {
  if (guards_alive > 0) ++allocation_count;
}

}  // namespace

namespace trocar::test {

AllocationGuard::AllocationGuard() : start_(allocation_count) { ++guards_alive; }
AllocationGuard::~AllocationGuard() { --guards_alive; }
std::uint64_t AllocationGuard::allocations() const { return allocation_count - start_; }
bool AllocationGuard::catches_malloc() { return TROCAR_COUNTS_MALLOC != 0; }

}  // namespace trocar::test

#if TROCAR_COUNTS_MALLOC

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  note_allocation();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  note_allocation();
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) noexcept {
  note_allocation();
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  note_allocation();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  note_allocation();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) noexcept {
  note_allocation();
  if (alignment < sizeof(void*) || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* block = __libc_memalign(alignment, size);
  if (block == nullptr) return ENOMEM;
  *result = block;
  return 0;
}

}  // extern "C"

#else

namespace {

void* counted_malloc(std::size_t size) {
  note_allocation();
  return std::malloc(size == 0 ? 1 : size);
}

void* counted_new(std::size_t size) {
  void* block = counted_malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void* counted_aligned_new(std::size_t size, std::align_val_t alignment) {
  note_allocation();
  const auto step = static_cast<std::size_t>(alignment);
  void* block = std::aligned_alloc(step, (size + step - 1) / step * step);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

void* operator new(std::size_t size) { return counted_new(size); }
void* operator new[](std::size_t size) { return counted_new(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted_aligned_new(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted_aligned_new(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted_malloc(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted_malloc(size); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

#endif
