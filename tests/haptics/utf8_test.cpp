#include "haptics/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace trocar::utf8_test {
namespace {

TEST(Utf8, TakesEveryLengthAndTheEndsOfEachRange) {
  for (const char* text :
       {"", "liver", "Leber-\u00e4", "\u0080\u07ff", "\u0800\ud7ff\ue000\uffff", "\U00010000\U0010ffff"})
    EXPECT_TRUE(is_utf8(text)) << text;
}

// Unicode 15, table 3-7: what each first byte may not be followed by.
TEST(Utf8, RefusesWhatTheTableLeavesOut) {
  for (const char* bytes :
       {"\x80", "\xe4", "Leber-\xe4.nii", "\xc0\xaf", "\xc1\xbf", "\xc2", "\xc2\x41", "\xe0\x9f\xbf", "\xed\xa0\x80",
        "\xe1\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xf1\x80\x80"})
    EXPECT_FALSE(is_utf8(bytes));
}

}  // namespace
}  // namespace trocar::utf8_test
