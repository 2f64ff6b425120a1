#include "trainees/records/accounts.h"

#include <sodium.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>

#include "haptics/input_error.h"
#include "trainees/integrity/anchored_transaction.h"
#include "trainees/integrity/audit.h"
#include "trainees/integrity/kept_rows.h"
#include "trainees/integrity/sealed_rows.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/password_rules.h"
#include "trainees/records/printed_text.h"
#include "trainees/records/signing.h"
#include "trainees/records/trainee_store.h"

namespace trocar {
namespace {

constexpr std::size_t kShortestLogin = 2, kLongestLogin = 32, kLongestPassword = 1024;

/// Of a password that nobody knows, at the cost of the others: a login that does not exist takes as long.
constexpr const char* kNobody =
    "$argon2id$v=19$m=65536,t=2,p=1$tVhy7qshpHm00lpcSlXODw$eepptbEJrJTe6pzFHq1XN6y2qqbJ513A7wIJ5vzwhdg";

constexpr const char* kSelect =
    "SELECT a.uuid, a.login, a.name, a.role, coalesce(t.code, ''), a.created_utc, coalesce(a.disabled_utc, ''), "
    "a.password, a.id"
    " FROM account a LEFT JOIN known_trainee t ON t.id = a.trainee_id";

void start_library() {
  if (sodium_init() < 0) throw EnvironmentError("passwords: the library libsodium cannot be started");
}

bool digit(char c) { return c >= '0' && c <= '9'; }

void check_login(const std::string& login) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || digit(c) || c == '.' || c == '-' || c == '_';
  };
  if (login.size() >= kShortestLogin && login.size() <= kLongestLogin &&
      std::all_of(login.begin(), login.end(), allowed))
    return;
  throw InputError("login: give 2 to 32 letters, digits, '.', '-' or '_'");
}

std::string hashed(const std::string& password) {
  start_library();
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (crypto_pwhash_str(text.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                        crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0) {
    throw EnvironmentError("passwords: there is no room in memory to hash one (64 MiB)");
  }
  return text.data();
}

/// One that nobody would try first.
std::string random_pin(const std::string& login) {
  constexpr std::uint32_t kPins = 1000000;
  start_library();
  for (;;) {
    std::string pin = std::to_string(randombytes_uniform(kPins));
    pin.insert(0, 6 - pin.size(), '0');
    try {
      check_password(pin, Role::kTrainee, login);
      return pin;
    } catch (const InputError&) {
      continue;  // a sequence, a repetition
    }
  }
}

Account account_of(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.text(2), role_named(row.text(3)).value_or(Role::kTrainee),
          row.text(4), row.text(5), row.text(6)};
}

Account required(const std::optional<Account>& account, const std::string& login) {
  if (!account) throw InputError("account \"" + login + "\": there is none");
  return *account;
}

void note_coming(Database& database, const char* action, const std::string& account, const std::string& actor) {
  AnchoredTransaction transaction(database);
  append_audit(database.connection(), action, account, "", actor.empty() ? "trocar" : actor);
  transaction.commit();
}

/// Somebody must remain who can manage the desk: without any enabled account it would be open to whoever sits at the
/// machine.
void require_another(sqlite3* connection, const Account& account) {
  if (account.role == Role::kTrainee) return;
  sql::Statement others(connection,
                        "SELECT 1 FROM account WHERE uuid <> ?1 AND disabled_utc IS NULL AND password <> ''"
                        " AND (role = 'administrator' OR (role = 'instructor' AND ?2 = 'instructor'))");
  if (others.bind(account.uuid).bind(role_name(account.role)).step()) return;
  throw InputError("account \"" + account.login + "\": is the last " + role_name(account.role) +
                   " who can sign in; make or enable another one first, nothing was changed");
}

/// Whoever changed the row in the file without the station's key must not have it confirmed by the next signed entry.
void require_held(sqlite3* connection, const Account& account, const std::optional<Role>& confirmed) {
  sql::Statement row(connection, "SELECT row_holds('account', id) FROM account WHERE login = ?");
  if (confirmed ? *confirmed == account.role : row.bind(account.login).step() && row.integer(0) != 0) return;
  const std::string role = role_name(account.role);
  throw InputError("account \"" + account.login + "\": its row (" + role +
                   (account.trainee_code.empty() ? "" : " " + account.trainee_code) +
                   ") is not the one that the signed trail holds: it was changed by another way, or while the station's"
                   " key was missing. Nothing was changed; where " +
                   role + " is right: trocar review account password " + account.login + " --as " + role);
}

/// Row of the trainee whose account it is to be. Call inside the transaction.
std::int64_t trainee_without_account(sqlite3* connection, const std::string& code) {
  sql::Statement row(connection,
                     "SELECT p.trainee_id, a.login FROM person p LEFT JOIN account a ON a.trainee_id = p.trainee_id"
                     " WHERE p.code = ?");
  if (!row.bind(code).step()) throw InputError("trainee \"" + code + "\": there is none; add the trainee first");
  if (!row.is_null(1)) throw InputError("trainee \"" + code + "\": has the account \"" + row.text(1) + "\" already");
  require_person(connection, row.integer(0), code);
  return row.integer(0);
}

}  // namespace

const char* role_name(Role role) {
  switch (role) {
    case Role::kTrainee:
      return "trainee";
    case Role::kInstructor:
      return "instructor";
    case Role::kAdministrator:
      return "administrator";
  }
  return "";
}

std::optional<Role> role_named(const std::string& name) {
  for (const Role role : {Role::kTrainee, Role::kInstructor, Role::kAdministrator}) {
    if (name == role_name(role)) return role;
  }
  return std::nullopt;
}

Account AccountStore::add(const std::string& login, const std::string& name, Role role, const std::string& trainee_code,
                          const std::string& password, const std::string& author) {
  check_login(login);
  check_printed("name", name);
  check_password(password, role, login);
  if ((role == Role::kTrainee) == trainee_code.empty()) {
    throw InputError(role == Role::kTrainee ? "account: say whose it is by the trainee's code"
                                            : "account: only a trainee's has a trainee code");
  }
  const std::string hash = hashed(password), uuid = make_uuid();
  sqlite3* connection = database_->connection();
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  if (find(login)) throw InputError("login \"" + login + "\": is taken");
  sql::Statement insert(connection,
                        "INSERT INTO account (uuid, login, name, role, trainee_id, password, created_utc)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.bind(uuid).bind(login).bind(name).bind(role_name(role));
  if (role == Role::kTrainee)
    insert.bind(trainee_without_account(connection, trainee_code));
  else
    insert.bind_null();
  insert.bind(hash).bind(utc_now()).run();
  seal_account(connection, "account added", uuid, author);
  transaction.commit();
  return by_uuid(uuid).value();
}

void AccountStore::set_password(const std::string& login, const std::string& password, const std::string& author,
                                const std::optional<Role>& confirmed) {
  check_password(password, required(find(login), login).role, login);
  const std::string hash = hashed(password);
  AnchoredTransaction transaction(*database_);
  require_key(*database_);
  const Account account = required(find(login), login);
  require_held(database_->connection(), account, confirmed);
  sql::Statement(database_->connection(), "UPDATE account SET password = ? WHERE uuid = ?")
      .bind(hash)
      .bind(account.uuid)
      .run();
  seal_account(database_->connection(), "account password", account.uuid, author);
  transaction.commit();
}

std::string AccountStore::give_pin(const std::string& trainee_code, const std::string& author) {
  const auto account = of_trainee(trainee_code);
  const std::string login = account ? account->login : trainee_code, pin = random_pin(login);
  if (account) {
    set_password(login, pin, author);
    return pin;
  }
  const auto trainee = TraineeStore(*database_).find(trainee_code);
  if (!trainee) throw InputError("trainee \"" + trainee_code + "\": there is none");
  add(login, trainee->name.empty() ? trainee->code : trainee->name, Role::kTrainee, trainee->code, pin, author);
  return pin;
}

void AccountStore::set_own_password(const std::string& login, const std::string& present, const std::string& fresh) {
  const auto account = verify(login, present);
  if (!account) throw InputError("account \"" + login + "\": the present password is wrong; nothing was changed");
  if (fresh == present) throw InputError("password: this is the present one; take another");
  set_password(login, fresh, account->uuid);
}

void AccountStore::set_disabled(const std::string& login, bool disabled, const std::string& author) {
  AnchoredTransaction transaction(*database_);
  const Account account = required(find(login), login);
  if (disabled != account.disabled_utc.empty()) return;  // it is so already
  require_key(*database_);
  require_held(database_->connection(), account, std::nullopt);
  if (disabled) require_another(database_->connection(), account);
  sql::Statement update(database_->connection(), "UPDATE account SET disabled_utc = ? WHERE uuid = ?");
  if (disabled)
    update.bind(utc_now());
  else
    update.bind_null();
  update.bind(account.uuid).run();
  seal_account(database_->connection(), disabled ? "account disabled" : "account enabled", account.uuid, author);
  transaction.commit();
}

void AccountStore::signed_in(const std::string& account) { note_coming(*database_, "signed in", account, account); }
void AccountStore::signed_out(const std::string& account) { note_coming(*database_, "signed out", account, account); }
void AccountStore::held_back(const std::string& account) { note_coming(*database_, "sign-in held back", account, ""); }

bool accounts_kept(sqlite3* connection, bool enabled) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, bool>, AuditHead> none_up_to;  // by file
  if (!trail_goes_on(connection)) return true;
  const std::lock_guard lock(mutex);
  AuditHead& known = none_up_to[{sqlite3_db_filename(connection, "main"), enabled}];
  if (known.position > 0 && audit_hash(connection, known.position) != known.row_hash) known = {};
  const AuditHead head = audit_head(connection);
  sql::Statement row(
      connection,
      // not OR, which asks for both: with accounts the trail would be read from its beginning for every page
      "SELECT CASE WHEN EXISTS (SELECT 1 FROM account WHERE password <> '' AND (NOT ?1 OR disabled_utc IS NULL)) THEN 1"
      " ELSE EXISTS (SELECT 1 FROM audit u WHERE position > ?2 AND action IN ('account added', 'account enabled') AND "
      "(SELECT"
      " action FROM audit n WHERE n.subject = u.subject AND n.action IN ('account added', 'account disabled',"
      " 'account enabled', 'account erased') ORDER BY n.position DESC LIMIT 1) NOT IN"
      " ('account erased', CASE WHEN ?1 THEN 'account disabled' ELSE '' END)) END");
  // Of a trail that somebody has altered nobody knows what it said of accounts.
  if (row.bind(enabled).bind(known.position).step() && row.integer(0) != 0) return true;
  if (!trail_whole(connection, known.position)) return true;
  known = head;
  return false;
}

std::optional<Account> AccountStore::verify(const std::string& login, const std::string& password) const {
  start_library();
  std::optional<Account> account;
  std::string hash = kNobody;
  bool held = false;
  {
    sql::Statement row(database_->connection(), std::string(kSelect) +
                                                    " WHERE a.login = ? AND a.disabled_utc IS NULL"
                                                    " AND a.password <> ''");
    if (row.bind(login).step()) {
      account = account_of(row);
      hash = row.text(7);
      held = row_holds(database_->connection(), "account", row.integer(8));
    }
  }
  const std::string given = password.substr(0, kLongestPassword + 1);  // what is longer is wrong, and takes no longer
  const bool right = crypto_pwhash_str_verify(hash.c_str(), given.data(), given.size()) == 0;
  return right && held ? account : std::nullopt;
}

std::optional<Account> AccountStore::find(const std::string& login) const {
  sql::Statement row(database_->connection(), std::string(kSelect) + " WHERE a.login = ?");
  if (!row.bind(login).step()) return std::nullopt;
  return account_of(row);
}

std::optional<Account> AccountStore::of_trainee(const std::string& code) const {
  sql::Statement row(database_->connection(), std::string(kSelect) + " WHERE t.code = ?");
  if (!row.bind(code).step()) return std::nullopt;
  return account_of(row);
}

std::optional<Account> AccountStore::by_uuid(const std::string& uuid) const {
  sql::Statement row(database_->connection(), std::string(kSelect) + " WHERE a.uuid = ?");
  if (!row.bind(uuid).step()) return std::nullopt;
  return account_of(row);
}

std::vector<Account> AccountStore::list() const {
  std::vector<Account> accounts;
  sql::Statement rows(database_->connection(), std::string(kSelect) + " ORDER BY a.login");
  while (rows.step()) accounts.push_back(account_of(rows));
  return accounts;
}

}  // namespace trocar
