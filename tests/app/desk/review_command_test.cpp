// Accounts from the command line, and where passwords come from.
#include "app/desk/review_command.h"

#include <gtest/gtest.h>

#include <sstream>

#include "app/desk/password_prompt.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "trainees/records/accounts.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review_command_test {
namespace {

using test::message_of;

TEST(PasswordPrompt, TakesTheFirstLine) {
  std::ostringstream err;
  std::istringstream two("first line \nsecond\n"), windows("word\r\n"), cut("word"), nothing("");
  EXPECT_EQ(new_password("ines", two, err), "first line ") << "spaces belong to it";
  EXPECT_EQ(new_password("ines", windows, err), "word");
  EXPECT_EQ(new_password("ines", cut, err), "word");
  EXPECT_NE(message_of<InputError>([&] { new_password("ines", nothing, err); }).find("no password came in"),
            std::string::npos);
  EXPECT_EQ(err.str(), "");
}

TEST(ReviewServe, SaysHowLittleRoomThereIsToWrite) {
  EXPECT_EQ(little_room("/data", 40'000'000), "");
  EXPECT_EQ(little_room("/data", 340'000).find("/data: the disk is nearly full, 340.0 kB are free: "), 0U);
  EXPECT_EQ(little_room("/data", 0).find("/data: the disk is nearly full, 0 B are free: "), 0U);
}

class ReviewAccounts : public testing::Test {
 protected:
  int add(const std::string& login, const std::string& role, const std::string& password,
          const std::string& trainee = "") {
    ReviewAccountOptions options{.database = file_, .login = login, .role = role, .trainee = trainee};
    std::istringstream in(password + "\n");
    return review_account_add(options, in, out_, err_);
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "desk.db";
  std::ostringstream out_, err_;
};

TEST_F(ReviewAccounts, AddChangeDisableList) {
  {
    Database database(file_);
    TraineeStore(database).ensure_trainee("T01");
  }
  EXPECT_EQ(add("T01", "trainee", "580274"), 0);
  EXPECT_NE(err_.str().find("No instructor has an account yet"), std::string::npos) << "everybody signs in from now on";
  err_.str("");
  EXPECT_EQ(add("ines", "instructor", "correct horse battery"), 0);
  EXPECT_EQ(err_.str(), "");
  EXPECT_EQ(out_.str(), "T01 trainee\nines instructor\n");
  std::istringstream in("another password\n");
  EXPECT_EQ(review_account_password({.database = file_, .login = "ines"}, in, out_, err_), 0);
  EXPECT_EQ(review_account_disable({.database = file_, .login = "T01"}, true, out_, err_), 0);
  Database database(file_);
  const AccountStore accounts(database);
  EXPECT_FALSE(accounts.verify("ines", "correct horse battery"));
  EXPECT_TRUE(accounts.verify("ines", "another password"));
  EXPECT_FALSE(accounts.verify("T01", "580274"));
  out_.str("");
  EXPECT_EQ(review_account_list({.database = file_}, out_, err_), 0);
  EXPECT_NE(out_.str().find("instructor"), std::string::npos);
  EXPECT_EQ(out_.str().find("argon2"), std::string::npos);
}

TEST_F(ReviewAccounts, EveryoneSetsTheirOwnPasswordByThePresentOne) {
  EXPECT_EQ(add("ines", "instructor", "correct horse battery"), 0);
  const ReviewAccountOptions own{.database = file_, .login = "ines", .own = true};
  std::istringstream wrong("wrong horse battery\nmy very own one\n");
  EXPECT_NE(message_of<InputError>([&] {
              review_account_password(own, wrong, out_, err_);
            }).find("the present password is wrong"),
            std::string::npos);
  std::istringstream right("correct horse battery\nmy very own one\n");
  EXPECT_EQ(review_account_password(own, right, out_, err_), 0);
  Database database(file_);
  EXPECT_TRUE(AccountStore(database).verify("ines", "my very own one"));
}

TEST_F(ReviewAccounts, RefuseWhatIsWrong) {
  EXPECT_NE(message_of<InputError>([&] { add("kim", "king", "correct horse battery"); }).find("--role king"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { add("kim", "trainee", "580274"); }), "") << "no such trainee";
  EXPECT_NE(message_of<InputError>([&] { add("kim", "instructor", "short"); }), "");
  std::istringstream in("long enough now\n");
  EXPECT_NE(message_of<InputError>([&] {
              review_account_password({.database = file_, .login = "kim"}, in, out_, err_);
            }).find("there is none"),
            std::string::npos);
  EXPECT_EQ(out_.str(), "");
}

}  // namespace
}  // namespace trocar::review_command_test
