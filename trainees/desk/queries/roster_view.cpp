#include <algorithm>
#include <set>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_rows.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/record_views.h"
#include "trainees/desk/queries/roster_views.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

constexpr const char* kTicked = "p:";  // a field a person: names of fields are told apart, values are not

/// Everybody who has a name here. @param code "" for all.
std::vector<RosterEntry> everybody(Desk& desk, const std::string& code) {
  sqlite3* connection = desk.database.connection();
  const std::set<std::int64_t> away = deactivated(connection);
  std::map<std::int64_t, std::pair<int, std::int64_t>> tried;  // how many, the newest
  sql::Statement attempts(
      connection,
      "SELECT trainee_id, count(*), max(id) FROM attempt INDEXED BY attempt_by_trainee GROUP BY trainee_id");
  while (attempts.step()) tried[attempts.integer(0)] = {static_cast<int>(attempts.integer(1)), attempts.integer(2)};
  std::map<std::int64_t, std::vector<std::string>> groups;
  sql::Statement members(connection, "SELECT trainee_id, group_name FROM membership ORDER BY trainee_id, group_name");
  while (members.step()) groups[members.integer(0)].push_back(members.text(1));
  sql::Statement newest(connection, "SELECT started_utc FROM attempt WHERE id = ?");
  sql::Statement rows(connection,
                      "SELECT p.trainee_id, p.code, p.name, p.email, coalesce(a.login, '') FROM person p LEFT JOIN"
                      " account a ON a.trainee_id = p.trainee_id WHERE ?1 = '' OR p.code = ?1 ORDER BY p.code");
  rows.bind(code);
  std::vector<RosterEntry> out;
  while (rows.step()) {
    const std::int64_t id = rows.integer(0);
    RosterEntry one{rows.text(1), rows.text(2), rows.text(3), "", rows.text(4), groups[id], 0, !away.contains(id)};
    if (const auto at = tried.find(id); at != tried.end()) {
      one.attempts = at->second.first;
      newest.bind(at->second.second).step();
      one.last_utc = newest.text(0);
      newest.run();
    }
    out.push_back(std::move(one));
  }
  return out;
}

RosterEntry required_entry(Desk& desk, const std::string& code) {
  std::vector<RosterEntry> found = code.empty() ? std::vector<RosterEntry>{} : everybody(desk, code);
  if (found.empty()) throw InputError("trainee \"" + code + "\": there is none");
  return found.front();
}

}  // namespace

bool may_give_pins(const Desk& desk, const Request& request) {
  return request.account && request.account->role == Role::kAdministrator && !request.account->uuid.empty() &&
         !accounts_view(desk.database, "").first;
}

RosterView roster_view(Desk& desk, const Request& request) {
  RosterView view;
  view.group = argument(request.query, "group");
  view.who = argument(request.query, "who", "active");
  view.page = whole_number(argument(request.query, "page"), 1);
  view.groups = CurriculumStore(desk.database).groups();
  view.pins = may_give_pins(desk, request);
  for (RosterEntry& one : everybody(desk, "")) {
    view.deactivated += one.active ? 0 : 1;
    if ((view.who == "active" && !one.active) || (view.who == "deactivated" && one.active)) continue;
    if (view.group.empty() || std::find(one.groups.begin(), one.groups.end(), view.group) != one.groups.end())
      view.people.push_back(std::move(one));
  }
  return view;
}

PersonView person_view(Desk& desk, const std::string& code) {
  PersonView view;
  view.person = required_entry(desk, code);
  view.standing = StandingStore(desk.database).of(view.person.code);
  return view;
}

ImportView import_view(Desk& desk, const Request& request) {
  return {argument(request.form, "csv"),
          argument(request.form, "group"),
          CurriculumStore(desk.database).groups(),
          "",
          {},
          false,
          may_give_pins(desk, request)};
}

std::vector<SignInCard> cards_of(Desk& desk, const std::vector<std::string>& codes) {
  std::vector<SignInCard> out;
  const std::set<std::string> wanted(codes.begin(), codes.end());
  for (RosterEntry& one : everybody(desk, ""))
    if (wanted.contains(one.code)) out.push_back({one.code, one.name, one.login, std::move(one.groups), "", ""});
  if (out.size() != wanted.size())
    throw InputError("cards: somebody of these is no longer here; open the roster again");
  return out;
}

std::vector<std::string> ticked(const std::map<std::string, std::string>& form) {
  std::vector<std::string> out;
  for (const auto& [name, value] : form)
    if (name.starts_with(kTicked)) out.push_back(name.substr(2));
  return out;
}

}  // namespace trocar::review
