// What the administrators' pages show, as plain values, and how it is read: accounts, the record itself, its audit
// trail, who is old enough to be forgotten. Nothing here changes the record. Thread: that of the Database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/recordings_checked.h"
#include "trainees/records/accounts.h"

namespace trocar::review {

struct AccountsView {
  std::vector<Account> accounts = {};
  std::vector<std::string> without = {};  ///< codes of trainees who have none
  std::string own_login = {};             ///< of who looks
  bool first = false;                     ///< no administrator can sign in yet
};

struct BackupFile {
  std::string name = {}, utc = {};
  std::uintmax_t bytes = 0;
};

struct RecordView {
  std::string file = {}, program = {}, head = {};  ///< name without its folder; head of the audit trail
  int schema = 0;
  std::uintmax_t database_bytes = 0, recordings_bytes = 0;
  std::vector<std::pair<std::string, std::int64_t>> counts = {};
  std::vector<BackupFile> backups = {};                   ///< beside the database, newest first
  std::optional<std::vector<std::string>> problems = {};  ///< of a check just made; empty: sound
  std::vector<std::string> remarks = {};                  ///< of that check, no problems
  std::size_t set_back = 0;                               ///< how often the clock was, in the whole trail
  std::optional<RecordingsChecked> recordings = {};       ///< graded again in the background
};

struct AuditQuestion {
  std::string person = {}, action = {};
  int page = 1;
};

struct AuditEntry {
  std::int64_t position = 0;
  std::string utc = {}, who = {}, action = {}, subject = {}, detail = {};
  bool named = true;            ///< `who` is an account's name, not words for what has none
  std::string before_utc = {};  ///< where the clock was set back before it: what it had said
  std::string words = {};  ///< what the subject is, for people: "attempt no. 12 of T-7"; "" where it says so itself
  std::string page = {};   ///< path of the page about it, "" where there is none
  bool is_signed = true;   ///< with the station's key, or older than the first
};

inline constexpr int kAuditOnPage = 100;

struct AuditView {
  AuditQuestion asked = {};
  std::int64_t total = 0;                                         ///< that match
  std::vector<AuditEntry> entries = {};                           ///< of that page, newest first
  std::vector<std::pair<std::string, std::string>> persons = {};  ///< actor and its name
  std::vector<std::string> actions = {};
  std::size_t set_back = 0;  ///< how often the clock was, in the whole trail
};

struct RetentionLine {
  std::string code = {}, last_utc = {}, created_utc = {};
  int attempts = 0;
};

struct RetentionView {
  int days = 730;
  std::string problem = {};
  std::vector<RetentionLine> lines = {};
};

AccountsView accounts_view(const Database& database, const std::string& own_login);
RecordView record_view(const Database& database, const std::string& program);
AuditView audit_view(const Database& database, const AuditQuestion& asked);
/// @param days as typed; what is no number from 1 to 36500 becomes the view's problem.
RetentionView retention_view(Database& database, const std::string& days, const std::string& now_utc);

std::string accounts_page(const AccountsView& view, Frame frame);
std::string record_page(const RecordView& view, Frame frame);
std::string audit_page(const AuditView& view, Frame frame);
std::string retention_page(const RetentionView& view, Frame frame);
/// Asks whether the invented cohort shall go; and what is said when it has gone, and where to.
std::string demo_question_page(Frame frame);
std::string demo_gone_page(Frame frame, const std::string& moved);

}  // namespace trocar::review
