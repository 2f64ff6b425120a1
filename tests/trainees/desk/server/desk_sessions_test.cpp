// Sessions and their tokens; how often somebody may try to sign in. Time is a number here.
#include "trainees/desk/server/desk_sessions.h"

#include <gtest/gtest.h>

#include <set>

#include "trainees/desk/server/sign_in_limit.h"

namespace trocar::review::desk_sessions_test {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

const DeskTime kBegin = DeskTime(std::chrono::hours(1000));

TEST(DeskSessions, NumbersAreLongAndDiffer) {
  const DeskSessions ready;
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string number = DeskSessions::fresh_number();
    EXPECT_TRUE(DeskSessions::is_number(number)) << number;
    seen.insert(number);
  }
  EXPECT_EQ(seen.size(), 1000U);
  for (const char* text :
       {"", "short", "0123456789012345678901234567890123456789012=", "0123456789012345678901234567890123456789 12"}) {
    EXPECT_FALSE(DeskSessions::is_number(text)) << text;
  }
}

TEST(DeskSessions, EndAfterIdlenessAndAtTheLatest) {
  DeskSessions sessions;
  const std::string number = sessions.begin({"uuid", "stamp"}, kBegin);
  EXPECT_EQ(sessions.find(number, kBegin + minutes(30))->account, "uuid");
  EXPECT_TRUE(sessions.find(number, kBegin + minutes(60))) << "used in between";
  EXPECT_FALSE(sessions.find(number, kBegin + minutes(60) + seconds(1801)));
  EXPECT_FALSE(sessions.find(number, kBegin + minutes(60))) << "it does not come back";
  const std::string busy = sessions.begin({"uuid", "stamp"}, kBegin);
  for (int i = 0; i <= 36; ++i) EXPECT_TRUE(sessions.find(busy, kBegin + minutes(20 * i))) << i;
  EXPECT_FALSE(sessions.find(busy, kBegin + minutes(721))) << "12 h are the most, however busy";
}

TEST(DeskSessions, EndOnRequest) {
  DeskSessions sessions;
  const std::string one = sessions.begin({"a", ""}, kBegin), other = sessions.begin({"a", ""}, kBegin);
  sessions.end(one);
  EXPECT_FALSE(sessions.find(one, kBegin));
  EXPECT_TRUE(sessions.find(other, kBegin));
  EXPECT_FALSE(sessions.find(DeskSessions::fresh_number(), kBegin));
  EXPECT_FALSE(sessions.find("", kBegin));
}

TEST(DeskSessions, OneAccountDrivesOutOnlyItself) {
  DeskSessions sessions({.of_account = 3, .of_all = 5});
  const std::string other = sessions.begin({"other", ""}, kBegin);
  std::vector<std::string> own;
  for (int i = 0; i < 6; ++i) own.push_back(sessions.begin({"own", ""}, kBegin + seconds(i)));
  EXPECT_TRUE(sessions.find(other, kBegin + seconds(10)));
  EXPECT_FALSE(sessions.find(own[2], kBegin + seconds(10)));
  EXPECT_TRUE(sessions.find(own[3], kBegin + seconds(10)));
  for (int i = 0; i < 20; ++i) sessions.begin({"account " + std::to_string(i), ""}, kBegin + seconds(20));
  EXPECT_EQ(sessions.count(), 5U);
}

TEST(DeskSessions, TokensBelongToTheirNumber) {
  const DeskSessions sessions, others;
  const std::string a = DeskSessions::fresh_number(), b = DeskSessions::fresh_number();
  EXPECT_TRUE(sessions.token_fits(a, sessions.token(a)));
  EXPECT_FALSE(sessions.token_fits(a, sessions.token(b)));
  EXPECT_FALSE(sessions.token_fits(a, others.token(a))) << "the key is the program's";
  EXPECT_FALSE(sessions.token_fits(a, ""));
  EXPECT_FALSE(sessions.token_fits(a, a));
  EXPECT_FALSE(sessions.token_fits(a, sessions.token(a) + "x"));
  EXPECT_EQ(sessions.token(a).find(a), std::string::npos);
}

TEST(SignInLimit, FiveWrongThenAGrowingWait) {
  SignInLimit limit;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin), 0) << i;
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin), 30);
  EXPECT_EQ(limit.begin("ANNA", "10.0.0.1", kBegin + seconds(10)), 20) << "in any case";
  EXPECT_EQ(limit.begin("anna", "10.0.0.2", kBegin + seconds(10)), 0) << "elsewhere she gets in";
  EXPECT_EQ(limit.begin("boris", "10.0.0.1", kBegin + seconds(10)), 20) << "the address counts for any login";
  EXPECT_EQ(limit.begin("boris", "10.0.0.2", kBegin), 0);
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(30)), 0) << "held back tries count nothing";
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(30)), 60);
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(90)), 0);
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(90)), 120);
  EXPECT_EQ(limit.begin("boris", "10.0.0.1", kBegin + minutes(17)), 0) << "an address is forgiven after 15 minutes";
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(210)), 0);
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin + seconds(210)), 240) << "a login after a day";
}

TEST(SignInLimit, SomeHundredGuessesADay) {
  SignInLimit limit;
  DeskTime now = kBegin;
  int taken = 0, longest = 0;
  for (int i = 0; i < 24 * 3600; i += 10, now += seconds(10)) {
    const int wait = limit.begin("anna", "10.0.0.1", now);
    taken += wait == 0;
    longest = std::max(longest, wait);
  }
  EXPECT_LE(longest, 900);
  EXPECT_LE(taken, 24 * 4 + 10);
  EXPECT_GE(taken, 24 * 4) << "who owns the login is not shut out for good";
}

TEST(SignInLimit, TheRightOneClearsTheLoginNotTheAddress) {
  SignInLimit limit;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin), 0);
  EXPECT_EQ(limit.begin("anna", "10.0.0.1", kBegin), 0);
  limit.was_right("anna", "10.0.0.1");
  EXPECT_EQ(limit.begin("anna", "10.0.0.9", kBegin), 0);
  EXPECT_EQ(limit.begin("boris", "10.0.0.1", kBegin), 0) << "its own try did not count, four wrong ones did";
  EXPECT_GT(limit.begin("boris", "10.0.0.1", kBegin), 0);
}

TEST(SignInLimit, GuessesFromManyAddressesWaitButNotWhereTheLoginWasRight) {
  SignInLimit limit;
  EXPECT_EQ(limit.begin("ines", "10.0.0.1", kBegin), 0);
  limit.was_right("ines", "10.0.0.1");
  int taken = 0;
  for (int i = 0; i < 250; ++i) taken += limit.begin("ines", "10.2.0." + std::to_string(i), kBegin) == 0;
  EXPECT_EQ(taken, 100);
  EXPECT_EQ(limit.begin("ines", "10.0.0.2", kBegin), 30);
  EXPECT_EQ(limit.begin("Ines", "10.0.0.1", kBegin), 0) << "where she has been before she gets in";
  for (int i = 0; i < 4; ++i) EXPECT_EQ(limit.begin("ines", "10.0.0.1", kBegin), 0);
  EXPECT_EQ(limit.begin("ines", "10.0.0.1", kBegin), 30) << "guessing waits there too";
}

TEST(SignInLimit, KeepsItsSizeAndItsHeldBack) {
  SignInLimit limit;
  for (int i = 0; i < 5; ++i) limit.begin("anna", "10.0.0.1", kBegin);
  for (int i = 0; i < 30000; ++i) {
    limit.begin("x" + std::to_string(i), "10.1." + std::to_string(i / 250) + "." + std::to_string(i % 250),
                kBegin - minutes(5) + std::chrono::milliseconds(i));
  }
  EXPECT_GT(limit.begin("anna", "10.0.0.1", kBegin), 0) << "a flood of old tries does not free it";
}

/// Tries from ever other addresses, each with another invented login.
void flood(SignInLimit& limit, int count, int& address, DeskTime now) {
  for (int i = 0; i < count; ++i, ++address)
    limit.begin("x" + std::to_string(address), "flood " + std::to_string(address), now);
}

TEST(SignInLimit, InventedLoginsFreeNobodysLogin) {
  for (const bool exists : {true, false}) {
    SignInLimit limit;
    int address = 0;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(limit.begin("T01", "a" + std::to_string(i), kBegin, exists), 0) << i;
    flood(limit, 20000, address, kBegin + seconds(5));
    EXPECT_EQ(limit.begin("T01", "b", kBegin + seconds(10), exists), 20) << exists;
    EXPECT_EQ(limit.begin("T01", "b", kBegin + seconds(30), exists), 0) << exists;
    flood(limit, 20000, address, kBegin + seconds(40));
    EXPECT_EQ(limit.begin("T01", "c", kBegin + seconds(50), exists), 40) << exists;
  }
}

TEST(SignInLimit, InventedLoginsDoNotClearTheFirstTriesOfOneThatExists) {
  SignInLimit limit;
  int address = 0, taken = 0;
  for (int i = 0; i < 150; ++i) {
    taken += limit.begin("T01", "a" + std::to_string(i), kBegin, true) == 0;
    flood(limit, 200, address, kBegin + seconds(1));
  }
  EXPECT_EQ(taken, 100);
}

TEST(HeldBack, IsToldWhenTheWaitBeginsAndNotAgain) {
  SignInLimit limit;
  DeskTime now{std::chrono::hours(1000)};
  for (int i = 1; i <= 5; ++i) {
    ASSERT_EQ(limit.begin("ines", "10.0.0.7", now), 0);
    EXPECT_EQ(limit.tell_held_back("ines", "10.0.0.7", now), i == 5) << i;
  }
  EXPECT_GT(limit.begin("ines", "10.0.0.7", now), 0);
  now += std::chrono::seconds(31);
  ASSERT_EQ(limit.begin("ines", "10.0.0.8", now), 0) << "the sixth, after the wait";
  EXPECT_FALSE(limit.tell_held_back("ines", "10.0.0.8", now));
}

TEST(HeldBack, TenThousandAddressesDoNotFloodTheTrail) {
  SignInLimit limit;
  DeskTime now{std::chrono::hours(1000)};
  int told = 0;
  for (int address = 0; address < 10000; ++address) {
    for (int i = 0; i < 5; ++i) {
      const std::string login = std::to_string(address * 5 + i), from = "10." + std::to_string(address);
      ASSERT_EQ(limit.begin(login, from, now), 0);
      told += limit.tell_held_back(login, from, now);
    }
  }
  EXPECT_EQ(told, 60);
  now += std::chrono::hours(2);
  for (int i = 0; i < 5; ++i) limit.begin("otto", "10.1.1.1", now);
  EXPECT_TRUE(limit.tell_held_back("otto", "10.1.1.1", now)) << "the next hour";
}

}  // namespace
}  // namespace trocar::review::desk_sessions_test
