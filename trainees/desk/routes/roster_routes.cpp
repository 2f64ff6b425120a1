// The roster: people, lists of them, groups of many at once, who is deactivated, cards to sign in with.
#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/roster_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/records/trainee_store.h"

namespace trocar::review {
namespace {

constexpr const char* kListName = "list";  // what messages call what was pasted
constexpr std::size_t kMostPins = 100;     // each takes some 50 ms to hash, and the page waits for all

Response roster_answer(std::string body, int status = 200) { return {.status = status, .body = std::move(body)}; }

std::string back_to_roster(const Request& request) {
  std::string out = "/roster", sign = "?";
  for (const char* name : {"group", "who"}) {
    const std::string value = argument(request.query, name);
    if (value.empty()) continue;
    out += sign + name + "=" + url_part(value);
    sign = "&";
  }
  return out + "#people";
}

Response roster(const Request& request, Desk& desk) {
  return roster_answer(roster_page(roster_view(desk, request), frame_of(request, desk)));
}

/// The roster with the form as it was sent.
Response roster_refusal(const Request& request, Desk& desk, const std::string& form, const std::string& why) {
  Frame frame = frame_of(request, desk);
  frame.refused = {form, why, request.form};
  return roster_answer(roster_page(roster_view(desk, request), frame), 400);
}

Response roster_file(const Request& request, Desk& desk) {
  return csv_file(roster_csv(roster_view(desk, request)), "roster.csv");
}

Response add_one(const Request& request, Desk& desk) {
  const auto& form = request.form;
  try {
    add_person(desk.database,
               {0, argument(form, "code"), argument(form, "name"), argument(form, "email"), argument(form, "group")},
               author_of(request));
  } catch (const InputError& error) {
    return roster_refusal(request, desk, "add", error.what());
  }
  return see("/roster#people");
}

Response cards_answer(const Request& request, Desk& desk, const std::vector<SignInCard>& cards) {
  return roster_answer(cards_page(cards, frame_of(request, desk)));
}

void change_groups(const Request& request, Desk& desk, const std::vector<std::string>& codes, bool join) {
  CurriculumStore store(desk.database);
  const std::string group = argument(request.form, "group");
  if (group.empty()) throw InputError("group: say which");
  if (join)
    store.join(codes, group, author_of(request));
  else
    store.leave(codes, group, author_of(request));
}

Response selected(const Request& request, Desk& desk) {
  const std::vector<std::string> codes = ticked(request.form);
  const std::string what = argument(request.form, "do");
  try {
    if (codes.empty()) throw InputError("nobody is ticked");
    if (what == "cards") return cards_answer(request, desk, cards_of(desk, codes));
    if (what == "join" || what == "leave")
      change_groups(request, desk, codes, what == "join");
    else if (what == "deactivate" || what == "reactivate")
      StandingStore(desk.database)
          .set_active({codes.begin(), codes.end()}, what == "reactivate", argument(request.form, "reason"),
                      author_of(request));
    else
      throw InputError("roster: nothing was asked for");
  } catch (const InputError& error) {
    return roster_refusal(request, desk, "selected", error.what());
  }
  return see(back_to_roster(request));
}

/// A PIN for everybody who is ticked. One who cannot have one keeps nobody else from theirs.
Response pins(const Request& request, Desk& desk) {
  const std::vector<std::string> codes = ticked(request.form);
  std::vector<SignInCard> cards;
  try {
    if (!may_give_pins(desk, request))
      throw InputError("PINs: make an administrator's account first, best your own, and sign in with it");
    if (codes.empty()) throw InputError("nobody is ticked");
    if (codes.size() > kMostPins)
      throw InputError("PINs: at most " + std::to_string(kMostPins) + " at a time; take a group first");
    cards = cards_of(desk, codes);
  } catch (const InputError& error) {
    return roster_refusal(request, desk, "selected", error.what());
  }
  AccountStore accounts(desk.database);
  for (SignInCard& card : cards) {
    try {
      if (!StandingStore(desk.database).of(card.code).active) throw InputError("no PIN: is deactivated");
      card.pin = accounts.give_pin(card.code, request.account->uuid);
      card.login = accounts.of_trainee(card.code)->login;
    } catch (const InputError& error) {
      card.problem = error.what();
    }
  }
  return cards_answer(request, desk, cards);
}

Response person(const Request& request, Desk& desk) {
  return roster_answer(person_page(person_view(desk, argument(request.query, "code")), frame_of(request, desk)));
}

/// What another desk has saved since the form was made is not lost; the same again is no loss.
void refuse_unseen_person(const std::map<std::string, std::string>& form, const Trainee& now) {
  const auto stands = [&](const char* name, const char* email) {
    return argument(form, name) == now.name && argument(form, email) == now.email;
  };
  if (stands("seen_name", "seen_email") || stands("name", "email")) return;
  throw InputError("trainee \"" + now.code + "\": was saved meanwhile with the name \"" +
                   (now.name.empty() ? "-" : now.name) + "\" and the e-mail address \"" +
                   (now.email.empty() ? "-" : now.email) + "\"; open the page again, and repeat what you changed");
}

Response change_person(const Request& request, Desk& desk) {
  const std::string code = argument(request.query, "code");
  const auto& form = request.form;
  try {
    TraineeStore(desk.database)
        .edit(code, argument(form, "name"), argument(form, "email"), author_of(request).account_uuid,
              [&](const Trainee& now) { refuse_unseen_person(form, now); });
  } catch (const InputError& error) {
    Frame frame = frame_of(request, desk);
    frame.refused = {"person", error.what(), request.form};
    return roster_answer(person_page(person_view(desk, code), frame), 400);
  }
  return see("/roster#people");
}

Response import_form_page(const Request& request, Desk& desk) {
  return roster_answer(import_page(import_view(desk, request), frame_of(request, desk)));
}

Response import_list(const Request& request, Desk& desk) {
  ImportView view = import_view(desk, request);
  try {
    if (argument(request.form, "do") == "take") {
      view.preview = take_people(desk.database, view.csv, kListName, view.group, author_of(request));
      view.done = true;
    } else {
      view.preview = preview_people(desk.database, view.csv, kListName, view.group);
    }
  } catch (const InputError& error) {
    view.problem = without_folders(error.what(), desk.database.file());
    return roster_answer(import_page(view, frame_of(request, desk)), 400);
  }
  return roster_answer(import_page(view, frame_of(request, desk)));
}

using RosterAction = Response (*)(const Request&, Desk&);

Route roster_route(const std::string& method, const std::string& path, RosterAction action,
                   Audience audience = Audience::kInstructors) {
  return {method, path, audience, [action, status = method == "GET" ? 404 : 400](const Request& request, Desk& desk) {
            return answered(request, desk, status, [&] { return action(request, desk); });
          }};
}

/// A form's address asked for as a page.
Route roster_form(const std::string& path) {
  return {"GET", path, Audience::kInstructors, [](const Request&, Desk&) { return see("/roster"); }};
}

}  // namespace

std::vector<Route> roster_routes() {
  return {roster_route("GET", "/roster", roster),
          roster_route("GET", "/roster.csv", roster_file),
          roster_route("POST", "/roster/add", add_one),
          roster_route("POST", "/roster/selected", selected),
          roster_route("POST", "/roster/pins", pins, Audience::kAdministrators),
          roster_route("GET", "/roster/person", person),
          roster_route("POST", "/roster/person", change_person),
          roster_route("GET", "/roster/import", import_form_page),
          roster_route("POST", "/roster/import", import_list),
          roster_form("/roster/add"),
          roster_form("/roster/selected"),
          roster_form("/roster/pins")};
}

}  // namespace trocar::review
