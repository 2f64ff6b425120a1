// What anybody would try first is refused; what is left is not few.
#include "trainees/records/password_rules.h"

#include <cstdio>

#include "tests/trainees/records/store_samples.h"

namespace trocar::password_rules_test {
namespace {

std::string refusal(const std::string& password, Role role, const std::string& login = "i.adler") {
  return message_of<InputError>([&] { check_password(password, role, login); });
}

TEST(PasswordRules, RefusePinsThatAreTriedFirst) {
  for (const char* pin : {"000000", "111111", "121212", "112112", "123123", "123456", "654321", "012345", "345678",
                          "901234", "123321", "456654", "112233", "147258", "369258"})
    EXPECT_NE(refusal(pin, Role::kTrainee), "") << pin;
  for (const char* pin : {"1234", "0000", "12345", "1234567"})
    EXPECT_NE(refusal(pin, Role::kTrainee).find("a PIN of 6 digits"), std::string::npos) << pin;
  EXPECT_NE(refusal("580274", Role::kTrainee, "580274").find("is the login"), std::string::npos);
  EXPECT_EQ(refusal("580274", Role::kTrainee), "");
  EXPECT_NE(refusal("580274", Role::kInstructor).find("at least 10"), std::string::npos) << "a PIN is a trainee's";
}

TEST(PasswordRules, LeaveNearlyEveryPin) {
  int taken = 0;
  for (int pin = 0; pin < 1000000; pin += 7) {
    char text[16];
    std::snprintf(text, sizeof text, "%06d", pin);
    if (refusal(text, Role::kTrainee).empty()) ++taken;
  }
  EXPECT_GT(taken, 0.99 * 1000000 / 7);
}

TEST(PasswordRules, RefusePasswordsThatAreTriedFirst) {
  for (const char* password : {"aaaaaaaaaa", "ababababab", "abcabcabcabc", "1234567890", "0987654321", "abcdefghij",
                               "qwertyuiop", "QwertzUiop", "asdfghjkl123", "qwertz12345", "Password123", "passwort2026",
                               "Willkommen1!", "administrator", "1q2w3e4r5t"})
    EXPECT_NE(refusal(password, Role::kInstructor).find("guessed first"), std::string::npos) << password;
  EXPECT_NE(refusal("ines.brandt", Role::kInstructor, "Ines.Brandt").find("is the login"), std::string::npos);
  EXPECT_NE(refusal("ines.brandt1", Role::kInstructor, "ines.brandt").find("is the login"), std::string::npos);
  for (const char* turned : {"brandt-ines", "brandtines1", "BrandtInes!"})
    EXPECT_NE(refusal(turned, Role::kInstructor, "ines.brandt").find("is the login"), std::string::npos) << turned;
  EXPECT_EQ(refusal("ines will kaffee", Role::kInstructor, "ines.brandt"), "");
  EXPECT_NE(refusal("tdnarb.seni", Role::kInstructor, "ines.brandt").find("is the login"), std::string::npos);
  EXPECT_NE(refusal("too short", Role::kInstructor).find("at least 10"), std::string::npos);
}

TEST(PasswordRules, TakeWhatNobodyTriesFirst) {
  for (const char* password : {"correct horse", "another password", "the login is adler", "7 lapar0scopes",
                               "abc is not enough", "\xC3\xA4\xC3\xB6\xC3\xBC\xC3\x9F zehn Zeichen"})
    EXPECT_EQ(refusal(password, Role::kInstructor), "") << password;
}

TEST(PasswordRules, KnowAPinByItsLook) {
  for (const char* pin : {"123456", "0", "99999999"}) EXPECT_TRUE(looks_like_pin(pin)) << pin;
  for (const char* other : {"", "12345a", "1234567890", "wrong"}) EXPECT_FALSE(looks_like_pin(other)) << other;
}

}  // namespace
}  // namespace trocar::password_rules_test
