// One's own password: whoever has an account sets it, with the present one.
#include "haptics/input_error.h"
#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/routes/page_routes.h"

namespace trocar::review {
namespace {

Response password(const Request& request, Desk& desk) {
  Frame frame = frame_of(request, desk);
  if (argument(request.query, "set") == "yes")
    frame.notice = "Your password is set. Other sign-ins of yours have ended.";
  return {.body = password_page(request.account->role == Role::kTrainee, frame)};
}

Response set_password(const Request& request, Desk& desk) {
  const Account& account = *request.account;
  AccountStore accounts(desk.database);
  const std::string fresh = argument(request.form, "fresh");
  try {
    require_confirmed(request);
    if (fresh != argument(request.form, "again")) throw InputError("the two new passwords differ");
    if (accounts.verify(account.login, fresh)) throw InputError("this is the present password: take another");
    accounts.set_password(account.login, fresh, account.uuid);
  } catch (const InputError& error) {
    Frame frame = frame_of(request, desk);
    frame.refused = {"password", error.what(), {}};
    return {.status = 400, .body = password_page(account.role == Role::kTrainee, frame)};
  }
  return see(std::string(kPasswordPath) + "?set=yes");
}

}  // namespace

std::vector<Route> password_routes() {
  return {{"GET", kPasswordPath, Audience::kSignedIn, password},
          {"POST", kPasswordPath, Audience::kSignedIn, set_password, true}};
}

}  // namespace trocar::review
