// What the pages of the roster show, as plain values, how it is read, and the pages: people with their groups, a list
// from a spreadsheet looked at, one person's fields, cards to sign in with. Nothing here changes the record. Thread:
// that of the Database.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/routes/route.h"
#include "trainees/records/people_import.h"
#include "trainees/records/standings.h"

namespace trocar::review {

struct RosterEntry {
  std::string code = {}, name = {}, email = {}, last_utc = {}, login = {};
  std::vector<std::string> groups = {};
  int attempts = 0;  ///< begun, finished or not
  bool active = true;
};

struct RosterView {
  std::string group = {}, who = "active";  ///< active, deactivated, all
  int page = 1;
  std::vector<std::string> groups = {};
  std::vector<RosterEntry> people = {};  ///< that match, by code
  int deactivated = 0;                   ///< in the whole record
  bool pins = false;                     ///< who looks may give PINs
};

struct PersonView {
  RosterEntry person = {};
  Standing standing = {};
};

struct ImportView {
  std::string csv = {}, group = {};
  std::vector<std::string> groups = {};
  std::string problem = {};  ///< why the list cannot be read
  std::optional<ImportPreview> preview = {};
  bool done = false;  ///< the preview is what was done
  bool pins = false;
};

struct SignInCard {
  std::string code = {}, name = {}, login = {};
  std::vector<std::string> groups = {};
  std::string pin = {};      ///< "" where none was made now
  std::string problem = {};  ///< why none could be made
};

RosterView roster_view(Desk& desk, const Request& request);
/// @throws InputError: nobody of that code.
PersonView person_view(Desk& desk, const std::string& code);
ImportView import_view(Desk& desk, const Request& request);
/// Without PINs. @throws InputError: nobody of one of the codes.
std::vector<SignInCard> cards_of(Desk& desk, const std::vector<std::string>& codes);
/// PINs are an administrator's, once one has an account: before, nobody could sign in to manage the others'.
bool may_give_pins(const Desk& desk, const Request& request);

/// Codes of the boxes that were ticked.
std::vector<std::string> ticked(const std::map<std::string, std::string>& form);

std::string roster_page(const RosterView& view, Frame frame);
std::string person_page(const PersonView& view, Frame frame);
std::string import_page(const ImportView& view, Frame frame);
std::string cards_page(const std::vector<SignInCard>& cards, Frame frame);
/// As a list that can be read back: code, name, email, group (the first), groups, state.
std::string roster_csv(const RosterView& view);
inline constexpr int kPeopleOnPage = 500;

}  // namespace trocar::review
