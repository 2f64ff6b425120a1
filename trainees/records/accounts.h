// Who may sign in at the desk: trainees (own data), instructors, administrators. Passwords as Argon2id by libsodium.
//
// Every change stands in the audit trail with who made it. Thread: that of the Database; verifying takes some 50 ms on
// purpose.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trainees/store/database.h"

namespace trocar {

enum class Role : std::uint8_t { kTrainee, kInstructor, kAdministrator };
const char* role_name(Role role);
std::optional<Role> role_named(const std::string& name);

struct Account {
  std::string uuid, login, name;
  Role role = Role::kTrainee;
  std::string trainee_code = {};  ///< of a trainee's account
  std::string created_utc = {}, disabled_utc = {};
};

/// Whether an account was made that is not erased, by its row or by the trail alone: no row that is taken away, or
/// emptied, opens what accounts close, nor does a trail that is no longer whole. Reads the trail from where it was last
/// found whole and naming none, for every page asks. @param enabled whether one that is disabled counts not.
bool accounts_kept(sqlite3* connection, bool enabled);

class AccountStore {
 public:
  explicit AccountStore(Database& database) : database_(&database) {}

  /// @param name as it is printed, 1 to 100 bytes without control characters.
  /// @param login 2 to 32 letters, digits, '.', '-' or '_'. @param trainee_code of a trainee's account; it must exist.
  /// @param password 10 to 1024 characters, or a PIN of 6 digits for trainees (password_rules.h). @param author
  /// account's UUID, "" from the command line.
  /// @throws InputError: taken, too short or too easily guessed, no such trainee.
  Account add(const std::string& login, const std::string& name, Role role, const std::string& trainee_code,
              const std::string& password, const std::string& author);
  /// @param confirmed the role that the account is to have, where its row is not the one that the trail holds.
  /// @throws InputError: no such account, too short or too easily guessed; a row that was changed by another way.
  void set_password(const std::string& login, const std::string& password, const std::string& author,
                    const std::optional<Role>& confirmed = std::nullopt);
  /// A new PIN of 6 digits for the account of that trainee, which is made under the code where there is none. The PIN
  /// can be read only here. @throws InputError: no such trainee, a code or login that fits no account.
  std::string give_pin(const std::string& trainee_code, const std::string& author);
  /// By its owner, who knows the present one: only then is it nobody else's (signing.h).
  /// @throws InputError: as above; the present one is wrong, or the new one is the same.
  void set_own_password(const std::string& login, const std::string& present, const std::string& fresh);
  /// An administrator is disabled only while another one can sign in, an instructor only while another instructor or
  /// administrator can.
  /// @throws InputError: no such account, the last of these, a row that was changed by another way.
  void set_disabled(const std::string& login, bool disabled, const std::string& author);

  /// In the audit trail: who came and went by account alone, no address; of wrong tries only that they were held back
  /// from then on.
  /// @param account UUID, of held_back "" for an account that does not exist.
  void signed_in(const std::string& account);
  void signed_out(const std::string& account);
  void held_back(const std::string& account);

  /// The account when the password is right, it may sign in and its row is the one that this program made: on record,
  /// and signed (docs/data_store.md). Takes as long for a login that does not exist.
  std::optional<Account> verify(const std::string& login, const std::string& password) const;
  std::optional<Account> find(const std::string& login) const;
  /// The account of the trainee of that code; nothing: there is none.
  std::optional<Account> of_trainee(const std::string& code) const;
  std::optional<Account> by_uuid(const std::string& uuid) const;
  std::vector<Account> list() const;

 private:
  Database* database_;
};

}  // namespace trocar
