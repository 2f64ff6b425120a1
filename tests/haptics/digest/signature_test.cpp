// Ed25519 against RFC 8032, section 7.1.
#include "haptics/digest/signature.h"

#include <gtest/gtest.h>

namespace trocar::signature_test {
namespace {

TEST(Signature, IsThatOfTheStandard) {
  const auto key = SigningKey::of_seed("4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb");
  ASSERT_TRUE(key);
  EXPECT_EQ(key->public_key(), "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c");
  const std::string signature = key->sign("\x72");
  EXPECT_EQ(
      signature,
      "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2eaeb430"
      "2aeeb00d291612bb0c00");
  EXPECT_TRUE(signature_holds(key->public_key(), "\x72", signature));
  EXPECT_FALSE(signature_holds(key->public_key(), "\x73", signature));
  EXPECT_FALSE(signature_holds(SigningKey::make().public_key(), "\x72", signature));
}

TEST(Signature, WhatIsNoneHoldsNothing) {
  const SigningKey key = SigningKey::make();
  EXPECT_NE(key.seed(), SigningKey::make().seed());
  for (const char* wrong : {"", "zz", "abc", "3d4017"}) {
    EXPECT_FALSE(SigningKey::of_seed(wrong)) << wrong;
    EXPECT_FALSE(signature_holds(wrong, "text", key.sign("text"))) << wrong;
    EXPECT_FALSE(signature_holds(key.public_key(), "text", wrong)) << wrong;
  }
}

}  // namespace
}  // namespace trocar::signature_test
