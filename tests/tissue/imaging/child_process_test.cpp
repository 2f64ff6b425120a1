#include "tissue/imaging/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <stdexcept>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::child_process_test {
namespace {

std::string refusal(const ChildLimits& limits, const std::function<std::string()>& work) {
  return test::message_of<InputError>([&] { in_child("scan.dcm", limits, {}, work); });
}

TEST(ChildProcess, GivesBackWhatTheWorkReturned) {
  const std::string large(3000000, 'x');
  EXPECT_EQ(in_child("scan.dcm", {}, {}, [&] { return large + std::string("\0y", 2); }), large + std::string("\0y", 2));
  EXPECT_EQ(in_child("scan.dcm", {}, {}, [] { return std::string(); }), "");
}

TEST(ChildProcess, PassesARefusalOnWordForWord) {
  EXPECT_EQ(refusal({}, []() -> std::string { throw InputError("scan.dcm: no pixels"); }), "scan.dcm: no pixels");
  EXPECT_EQ(refusal({}, []() -> std::string { throw std::runtime_error("bad tag"); }), "scan.dcm: bad tag");
}

TEST(ChildProcess, ACrashBecomesARefusal) {
  const std::string message = refusal({}, []() -> std::string {
    signal(SIGSEGV, SIG_DFL);
    raise(SIGSEGV);
    return "";
  });
  EXPECT_CONTAINS(message, "scan.dcm: the reader crashed");
  EXPECT_CONTAINS(refusal({}, []() -> std::string { _exit(3); }), "ended without a result");
}

TEST(ChildProcess, AHangEndsAtTheLimit) {
  const std::string message = refusal({.seconds = 1}, []() -> std::string {
    while (true) usleep(1000);
  });
  EXPECT_CONTAINS(message, "within 1 s");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ChildProcess, TooMuchMemoryIsRefused) {
  const std::string message =
      refusal({.memory_bytes = 64U << 20}, [] { return std::string(std::size_t{256} << 20, 'x'); });
  EXPECT_CONTAINS(message, "more memory");
}
#endif

TEST(ChildProcess, ProgressThatThrowsStopsTheChild) {
  int asked = 0;
  const Progress progress = [&](std::string_view, double) {
    if (++asked == 3) throw std::logic_error("stop");
  };
  EXPECT_THROW(in_child("scan.dcm", {}, progress,
                        []() -> std::string {
                          while (true) usleep(1000);
                        }),
               std::logic_error);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace trocar::child_process_test
