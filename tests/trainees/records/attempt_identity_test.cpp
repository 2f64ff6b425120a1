// UUIDs sort by time, and after one that was given whatever the clock says.
#include "trainees/records/attempt_identity.h"

#include <gtest/gtest.h>

#include <regex>

namespace trocar::attempt_identity_test {
namespace {

const std::regex kVersion7("[0-9a-f]{8}-[0-9a-f]{4}-7[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");

TEST(Uuids, FollowOneThatIsGiven) {
  std::string last = make_uuid();
  for (int i = 0; i < 1000; ++i) {
    const std::string next = make_uuid_after(last);
    ASSERT_GT(next, last);
    ASSERT_TRUE(std::regex_match(next, kVersion7)) << next;
    last = next;
  }
}

TEST(Uuids, FollowOneFromTheFuture) {
  for (const char* before : {"0fffffff-ffff-7fff-bfff-ffffffffffff", "0fffffff-fffe-7000-8000-000000000000"}) {
    const std::string next = make_uuid_after(before);
    EXPECT_GT(next, before);
    EXPECT_TRUE(std::regex_match(next, kVersion7)) << next;
  }
}

TEST(Uuids, DoNotMindATextThatIsNone) {
  for (const char* before : {"", "nonsense", "ffffffff-ffff-4fff-bfff-ffffffffffff"})
    EXPECT_LT(make_uuid_after(before), "1") << before;
}

}  // namespace
}  // namespace trocar::attempt_identity_test
