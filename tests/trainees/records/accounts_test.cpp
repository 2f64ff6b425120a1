// Accounts: who may sign in, with what, and that every change is on record.
#include "trainees/records/accounts.h"

#include "tests/trainees/records/store_samples.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/integrity/station_key.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::accounts_test {
namespace {

constexpr const char* kPassword = "correct horse";

class Accounts : public testing::Test {
 protected:
  std::string refusal(const std::string& login, const std::string& name, Role role, const std::string& code,
                      const std::string& password) {
    return message_of<InputError>([&] { store_.add(login, name, role, code, password, ""); });
  }
  Account instructor() { return store_.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, ""); }
  Database database_{":memory:"};
  AccountStore store_{database_};
};

using AccountsOnDisk = TemporaryFolder;

TEST_F(Accounts, TheRightPasswordSignsInAndNoOther) {
  const Account added = instructor();
  const auto account = store_.verify("i.adler", kPassword);
  ASSERT_TRUE(account);
  EXPECT_EQ(account->uuid, added.uuid);
  EXPECT_EQ(account->name, "Ida Adler");
  EXPECT_EQ(account->role, Role::kInstructor);
  EXPECT_TRUE(store_.verify("I.ADLER", kPassword)) << "a login's case does not matter";
  EXPECT_FALSE(store_.verify("i.adler", "correct horsf"));
  EXPECT_FALSE(store_.verify("i.adler", ""));
  EXPECT_FALSE(store_.verify("i.adler", std::string(kPassword) + '\0'));
  EXPECT_FALSE(store_.verify("i.adler", std::string(100000, 'x')));
  EXPECT_FALSE(store_.verify("nobody", kPassword));
  EXPECT_FALSE(store_.verify("' OR 1=1 --", kPassword));
}

TEST_F(Accounts, APasswordIsStoredAsArgon2idWithItsOwnSalt) {
  instructor();
  store_.add("second", "Second", Role::kAdministrator, "", kPassword, "");
  sql::Statement rows(database_.connection(), "SELECT password FROM account ORDER BY login");
  std::string last;
  while (rows.step()) {
    EXPECT_EQ(rows.text(0).find("$argon2id$v=19$m=65536,t=2,p=1$"), 0u) << rows.text(0);
    EXPECT_NE(rows.text(0), last) << "two salts";
    EXPECT_EQ(rows.text(0).find(kPassword), std::string::npos);
    last = rows.text(0);
  }
}

TEST_F(Accounts, ATraineesAccountIsBoundToTheTrainee) {
  EXPECT_NE(refusal("anna", "Anna", Role::kTrainee, "T-1", "580274").find("add the trainee first"), std::string::npos);
  TraineeStore(database_).ensure_trainee("T-1");
  const Account account = store_.add("anna", "Anna", Role::kTrainee, "t-1", "580274", "");
  EXPECT_EQ(account.trainee_code, "T-1");
  EXPECT_EQ(store_.verify("anna", "580274")->trainee_code, "T-1");
  EXPECT_NE(refusal("anna2", "Anna", Role::kTrainee, "T-1", "580274").find("has the account \"anna\" already"),
            std::string::npos);
  EXPECT_NE(refusal("x-ray", "X", Role::kTrainee, "", "580274").find("trainee's code"), std::string::npos);
  EXPECT_NE(refusal("x-ray", "X", Role::kInstructor, "T-1", kPassword).find("only a trainee's"), std::string::npos);
}

TEST_F(Accounts, BadLoginsNamesAndPasswordsAreRefused) {
  for (const std::string login : {"", "a", "a b", "a\nb", "\xC3\xA4\xC3\xA4", "a'b", "a/b"}) {
    EXPECT_NE(refusal(login, "N", Role::kInstructor, "", kPassword).find("login"), std::string::npos) << login;
  }
  EXPECT_NE(refusal(std::string(33, 'a'), "N", Role::kInstructor, "", kPassword), "");
  for (const std::string name : {"", "   ", "a\r\nSet-Cookie: x", "\xFF\xFE", "a\x7F"}) {
    EXPECT_NE(refusal("login", name, Role::kInstructor, "", kPassword).find("name"), std::string::npos) << name;
  }
  EXPECT_NE(refusal("login", "N", Role::kInstructor, "", "580274").find("at least 10"), std::string::npos)
      << "no PIN for instructors";
  EXPECT_NE(
      refusal("login", "N", Role::kInstructor, "", "\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4").find("at least 10"),
      std::string::npos)
      << "characters count, not bytes";
  EXPECT_NE(refusal("login", "N", Role::kInstructor, "", std::string(1025, 'x')).find("no more than 1024"),
            std::string::npos);
  TraineeStore(database_).ensure_trainee("T-1");
  for (const char* pin : {"12345", "1234567", "12345a"}) {
    EXPECT_NE(refusal("login", "N", Role::kTrainee, "T-1", pin).find("PIN of 6 digits"), std::string::npos) << pin;
  }
  EXPECT_TRUE(store_.list().empty());
}

TEST_F(Accounts, ALoginIsTakenWhateverItsCase) {
  instructor();
  EXPECT_NE(refusal("I.Adler", "Other", Role::kInstructor, "", kPassword).find("is taken"), std::string::npos);
  EXPECT_EQ(store_.list().size(), 1u);
}

TEST_F(Accounts, ADisabledAccountCannotSignInUntilItIsEnabled) {
  instructor();
  store_.add("second", "Second", Role::kInstructor, "", kPassword, "");
  store_.set_disabled("i.adler", true, "");
  EXPECT_FALSE(store_.verify("i.adler", kPassword));
  EXPECT_NE(store_.find("i.adler")->disabled_utc, "");
  store_.set_disabled("i.adler", false, "");
  EXPECT_TRUE(store_.verify("i.adler", kPassword));
  EXPECT_NE(message_of<InputError>([&] { store_.set_disabled("nobody", true, ""); }).find("there is none"),
            std::string::npos);
}

TEST_F(Accounts, ANewPasswordReplacesTheOld) {
  instructor();
  store_.set_password("i.adler", "a longer secret", "");
  EXPECT_FALSE(store_.verify("i.adler", kPassword));
  EXPECT_TRUE(store_.verify("i.adler", "a longer secret"));
  EXPECT_THROW(store_.set_password("i.adler", "short", ""), InputError);
  EXPECT_THROW(store_.set_password("nobody", "a longer secret", ""), InputError);
}

TEST_F(Accounts, EveryChangeIsOnRecordWithWhoMadeIt) {
  const Account admin = store_.add("root", "Root", Role::kAdministrator, "", kPassword, "");
  store_.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, admin.uuid);
  store_.set_password("i.adler", "a longer secret", admin.uuid);
  store_.set_disabled("i.adler", true, admin.uuid);
  store_.set_disabled("i.adler", true, admin.uuid);  // changes nothing, so no entry
  store_.set_disabled("i.adler", false, admin.uuid);
  sql::Statement rows(database_.connection(), "SELECT action, actor FROM audit WHERE position > 1 ORDER BY position");
  const std::vector<std::pair<std::string, std::string>> wanted{{"account added", "trocar"},
                                                                {"account added", admin.uuid},
                                                                {"account password", admin.uuid},
                                                                {"account disabled", admin.uuid},
                                                                {"account enabled", admin.uuid}};
  for (const auto& [action, actor] : wanted) {
    ASSERT_TRUE(rows.step());
    EXPECT_EQ(rows.text(0), action);
    EXPECT_EQ(rows.text(1), actor);
  }
  EXPECT_FALSE(rows.step());
  EXPECT_EQ(sql::query_integer(database_.connection(),
                               "SELECT count(*) FROM audit WHERE detail LIKE '%Adler%' OR subject LIKE '%adler%'"),
            0)
      << "the trail outlives the person: it names nobody";
  EXPECT_TRUE(database_.check().empty());
}

/// Who may write the file, but not read the key, makes himself no account.
TEST_F(AccountsOnDisk, ARowThatSomebodyWroteIntoTheFileSignsNobodyIn) {
  const std::filesystem::path file = folder_ / "t.db";
  Database database(file);
  AccountStore accounts(database);
  accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  ASSERT_TRUE(accounts.verify("i.adler", kPassword));
  EXPECT_EQ(run_outside(file,
                        "INSERT INTO account (uuid, login, name, role, password, created_utc) SELECT"
                        " '0190aaaa-0000-7000-8000-000000000001', 'mallory', name, 'administrator', password,"
                        " created_utc FROM account"),
            "");
  EXPECT_FALSE(accounts.verify("mallory", kPassword));
  EXPECT_EQ(run_without_triggers(file, "UPDATE account SET role = 'administrator' WHERE login = 'i.adler'"), "");
  EXPECT_FALSE(accounts.verify("i.adler", kPassword)) << "nor is anybody made more than he was";
}

TEST_F(AccountsOnDisk, UnderAnotherKeyNoAccountIsMade) {
  const std::filesystem::path file = folder_ / "t.db", key = key_path(file), kept = folder_ / "kept.key";
  Database database(file);
  AccountStore accounts(database);
  std::filesystem::rename(key, kept);
  write_station_key(file, SigningKey::make());
  const std::string head = database.head();
  EXPECT_THROW(accounts.add("mallory", "Mallory", Role::kAdministrator, "", kPassword, ""), InputError);
  EXPECT_EQ(database.head(), head);
  std::filesystem::rename(kept, key);
  accounts.add("i.adler", "Ida Adler", Role::kAdministrator, "", kPassword, "");
  EXPECT_TRUE(accounts.verify("i.adler", kPassword));
}

/// Whoever resets a password means the password, not what somebody made of the account.
TEST_F(AccountsOnDisk, APasswordSetAnewConfirmsNoRoleThatSomebodyWrote) {
  const std::filesystem::path file = folder_ / "t.db";
  Database database(file);
  AccountStore accounts(database);
  accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  accounts.add("second", "Second", Role::kAdministrator, "", kPassword, "");
  ASSERT_EQ(run_without_triggers(file, "UPDATE account SET role = 'administrator' WHERE login = 'i.adler'"), "");
  const auto refusal = [&](const std::function<void()>& action) { return message_of<InputError>(action); };
  EXPECT_NE(refusal([&] { accounts.set_password("i.adler", kPassword, ""); }).find("--as administrator"),
            std::string::npos);
  EXPECT_NE(refusal([&] { accounts.set_password("i.adler", kPassword, "", Role::kInstructor); }).find("--as"),
            std::string::npos);
  EXPECT_NE(refusal([&] { accounts.set_disabled("i.adler", true, ""); }).find("changed by another way"),
            std::string::npos);
  EXPECT_FALSE(accounts.verify("i.adler", kPassword));
  accounts.set_password("i.adler", kPassword, "", Role::kAdministrator);
  EXPECT_TRUE(accounts.verify("i.adler", kPassword));
}

/// Whoever announces a key of his own in the file is not the station, whose key lies beside it.
TEST_F(AccountsOnDisk, AnAccountUnderAKeyThatSomebodyAnnouncedSignsNobodyIn) {
  const std::filesystem::path file = folder_ / "t.db", key = key_path(file), kept = folder_ / "kept.key";
  Database database(file);
  AccountStore accounts(database);
  std::filesystem::rename(key, kept);
  const SigningKey own = SigningKey::make();
  write_station_key(file, own);
  {
    sql::Transaction transaction(database.connection());
    append_audit(database.connection(), kActionKey, kActionKey, own.public_key());
    transaction.commit();
  }
  accounts.add("mallory", "Mallory", Role::kAdministrator, "", kPassword, "");
  std::filesystem::rename(kept, key);
  EXPECT_FALSE(accounts.verify("mallory", kPassword));
  accounts.add("i.adler", "Ida Adler", Role::kAdministrator, "", kPassword, "");
  EXPECT_TRUE(accounts.verify("i.adler", kPassword)) << "the station goes on";
}

/// The signature is of a hash, and the hash of what the entry says.
TEST_F(AccountsOnDisk, ASignedEntryThatSomebodyChangedSignsNobodyIn) {
  const std::filesystem::path file = folder_ / "t.db";
  Database database(file);
  AccountStore accounts(database);
  const Account made = accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  ASSERT_EQ(run_without_triggers(file, "UPDATE account SET role = 'administrator'"), "");
  const std::string digest = digest_of_row(database.connection(), "account", made.uuid);
  ASSERT_EQ(run_without_triggers(file, "UPDATE audit SET detail = '" + digest + "' WHERE action = 'account added'"),
            "");
  EXPECT_FALSE(accounts.verify("i.adler", kPassword));
}

/// Passwords that somebody emptied, rows that somebody took away: what accounts close stays closed.
TEST_F(AccountsOnDisk, WithoutTheirRowsAccountsAreKeptByTheTrail) {
  const std::filesystem::path file = folder_ / "t.db";
  Database database(file);
  EXPECT_FALSE(accounts_kept(database.connection(), true));
  AccountStore accounts(database);
  accounts.add("i.adler", "Ida Adler", Role::kInstructor, "", kPassword, "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
  ASSERT_EQ(run_without_triggers(file, "UPDATE account SET password = ''"), "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
  ASSERT_EQ(run_without_triggers(file, "DELETE FROM account"), "");
  EXPECT_TRUE(accounts_kept(database.connection(), true));
}

TEST_F(Accounts, TheTableRefusesToMakeSomebodyElseOfAnAccount) {
  instructor();
  for (const char* change :
       {"UPDATE account SET role = 'administrator'", "UPDATE account SET login = 'other'", "DELETE FROM account",
        "INSERT OR REPLACE INTO account (uuid, login, name, role, created_utc)"
        " VALUES ('u', 'i.adler', 'N', 'instructor', '')"}) {
    EXPECT_THROW(sql::execute(database_.connection(), change), InputError) << change;
  }
  EXPECT_TRUE(store_.verify("i.adler", kPassword));
}

TEST_F(Accounts, SomebodyWhoCanManageTheDeskRemains) {
  const auto refusal_of = [&](const std::string& login) {
    return message_of<InputError>([&] { store_.set_disabled(login, true, ""); });
  };
  const auto add = [&](const char* login, Role role) { store_.add(login, login, role, "", kPassword, ""); };
  add("ines", Role::kInstructor);
  EXPECT_NE(refusal_of("ines").find("is the last instructor who can sign in"), std::string::npos);
  add("adam", Role::kAdministrator);
  EXPECT_NE(refusal_of("adam").find("is the last administrator who can sign in"), std::string::npos)
      << "an instructor is none";
  EXPECT_EQ(refusal_of("ines"), "") << "an administrator remains";
  add("eva", Role::kAdministrator);
  EXPECT_EQ(refusal_of("adam"), "");
  EXPECT_NE(refusal_of("eva").find("nothing was changed"), std::string::npos);
  EXPECT_TRUE(store_.verify("eva", kPassword));
  EXPECT_EQ(refusal_of("adam"), "") << "who is disabled already stays so";
  TraineeStore(database_).ensure_trainee("T-1");
  store_.add("anna", "Anna", Role::kTrainee, "T-1", "580274", "");
  EXPECT_EQ(refusal_of("anna"), "");
  EXPECT_TRUE(database_.check().empty());
}

TEST_F(Accounts, ComingAndGoingIsOnRecordByAccountAlone) {
  const Account account = instructor();
  store_.signed_in(account.uuid);
  store_.signed_out(account.uuid);
  store_.held_back(account.uuid);
  store_.held_back("");
  sql::Statement rows(database_.connection(),
                      "SELECT action, subject, actor, detail FROM audit WHERE action LIKE 'sign%' ORDER BY position");
  const std::vector<std::vector<std::string>> wanted{{"signed in", account.uuid, account.uuid, ""},
                                                     {"signed out", account.uuid, account.uuid, ""},
                                                     {"sign-in held back", account.uuid, "trocar", ""},
                                                     {"sign-in held back", "", "trocar", ""}};
  for (const auto& entry : wanted) {
    ASSERT_TRUE(rows.step());
    for (int column = 0; column < 4; ++column) EXPECT_EQ(rows.text(column), entry[static_cast<std::size_t>(column)]);
  }
  EXPECT_TRUE(database_.check().empty()) << "they say nothing of the account's row";
}

TEST(Roles, HaveNamesThatReadBack) {
  for (const Role role : {Role::kTrainee, Role::kInstructor, Role::kAdministrator})
    EXPECT_EQ(role_named(role_name(role)), role);
  EXPECT_FALSE(role_named("root"));
}

}  // namespace
}  // namespace trocar::accounts_test
