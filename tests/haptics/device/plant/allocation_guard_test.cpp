// The guard itself: a guard that sees nothing would let every test that leans on it pass.
#include "tests/support/allocation_guard.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

namespace trocar::test::allocation_guard_test {
namespace {

// Keeps the optimiser from removing a pair of allocation and release.
void touch(void* block) { asm volatile("" : : "g"(block) : "memory"); }

TEST(AllocationGuard, SeesOperatorNew) {
  const AllocationGuard guard;
  auto* number = new int(1);
  touch(number);
  EXPECT_EQ(guard.allocations(), 1u);
  delete number;
}

TEST(AllocationGuard, SeesContainersAndOverAlignedBlocks) {
  struct alignas(64) Wide {
    double lane[8];
  };
  const AllocationGuard guard;
  const auto wide = std::make_unique<Wide>();
  touch(wide.get());
  const std::vector<double> many(100, 1.0);
  EXPECT_EQ(guard.allocations(), 2u);
}

TEST(AllocationGuard, SeesMallocAndEigen) {
  if (!AllocationGuard::catches_malloc()) GTEST_SKIP() << "SKIPPED: a sanitizer owns malloc";
  const AllocationGuard guard;
  void* block = std::malloc(100);
  touch(block);
  block = std::realloc(block, 100000);
  touch(block);
  std::free(block);
  EXPECT_EQ(guard.allocations(), 2u);
  Eigen::VectorXd v(1000);
  touch(v.data());
  EXPECT_EQ(guard.allocations(), 3u);
}

TEST(AllocationGuard, IgnoresOtherThreadsAndWhatHappensWithoutAGuard) {
  touch(std::make_unique<int>(1).get());
  std::uint64_t seen = 1;
  std::thread other([&] {
    const std::vector<int> unguarded(10);
    const AllocationGuard guard;
    seen = guard.allocations();
  });
  other.join();
  EXPECT_EQ(seen, 0u);
}

TEST(AllocationGuard, Nests) {
  const AllocationGuard outer;
  touch(std::make_unique<int>(1).get());
  {
    const AllocationGuard inner;
    EXPECT_EQ(inner.allocations(), 0u);
    touch(std::make_unique<int>(1).get());
    EXPECT_EQ(inner.allocations(), 1u);
  }
  EXPECT_EQ(outer.allocations(), 2u);
}

}  // namespace
}  // namespace trocar::test::allocation_guard_test
