#include <algorithm>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/desk/queries/record_views.h"
#include "trainees/desk/routes/page_routes.h"
#include "trainees/desk/server/path_redaction.h"
#include "trainees/integrity/audit.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/record_backup.h"
#include "trainees/store/disk_full.h"

namespace trocar::review {
namespace {

Response html(std::string body, int status = 200) { return {.status = status, .body = std::move(body)}; }

/// The page of accounts with the form as it was sent, but for the passwords.
Response admin_refusal(const Request& request, Desk& desk, const std::string& form, const std::string& why) {
  Frame frame = frame_of(request, desk);
  frame.refused = {form, why, request.form};
  return html(accounts_page(accounts_view(desk.database, request.account->login), frame), 400);
}

Response accounts(const Request& request, Desk& desk) {
  return html(accounts_page(accounts_view(desk.database, request.account->login), frame_of(request, desk)));
}

Response add_account(const Request& request, Desk& desk) {
  const auto& form = request.form;
  const std::string login = argument(form, "login"), name = argument(form, "name"),
                    password = argument(form, "password");
  try {
    const auto role = role_named(argument(form, "role"));
    if (!role) throw InputError("role: trainee, instructor or administrator");
    if (*role != Role::kAdministrator && accounts_view(desk.database, "").first)
      throw InputError("the first account is an administrator's: nobody could make the others otherwise");
    if (password != argument(form, "again")) throw InputError("the two passwords differ");
    AccountStore(desk.database)
        .add(login, name.empty() ? login : name, *role, argument(form, "trainee"), password, request.account->uuid);
  } catch (const InputError& error) {
    return admin_refusal(request, desk, "account", error.what());
  }
  return see("/accounts#accounts");
}

Response change_account(const Request& request, Desk& desk, const std::string& form,
                        const std::function<void(AccountStore&, const std::string& login)>& change) {
  AccountStore store(desk.database);
  const std::string login = argument(request.arguments, "login");
  try {
    change(store, login);
  } catch (const InputError& error) {
    return admin_refusal(request, desk, form + login, error.what());
  }
  return see("/accounts#accounts");
}

Response new_password(const Request& request, Desk& desk) {
  return change_account(request, desk, "password-", [&](AccountStore& store, const std::string& login) {
    store.set_password(login, argument(request.form, "password"), request.account->uuid);
  });
}

Response set_disabled(const Request& request, Desk& desk, bool disabled) {
  return change_account(request, desk, "switch-", [&](AccountStore& store, const std::string& login) {
    if (disabled && login == request.account->login)
      throw InputError("this is your own account: let another administrator disable it");
    store.set_disabled(login, disabled, request.account->uuid);
  });
}

RecordView record_of(Desk& desk) {
  RecordView view = record_view(desk.database, desk.sources.program);
  if (desk.sources.recordings_checked) view.recordings = desk.sources.recordings_checked();
  return view;
}

Response record(const Request& request, Desk& desk) {
  return html(record_page(record_of(desk), frame_of(request, desk)));
}

Response check(const Request& request, Desk& desk) {
  if (desk.sources.check_recordings) desk.sources.check_recordings();
  RecordView view = record_of(desk);
  view.problems = desk.database.check();
  for (std::string& problem : AttemptStore(desk.database).check_recordings())
    view.problems->push_back(std::move(problem));
  for (std::string& remark : audit_remarks(desk.database.connection())) view.remarks.push_back(std::move(remark));
  return html(record_page(view, frame_of(request, desk)));
}

/// The record's page, which says why there is no backup.
Response backup_refusal(const Request& request, Desk& desk, int status, const std::string& why) {
  Frame frame = frame_of(request, desk);
  frame.refused = {"backup", without_folders(why, desk.database.file()), {}};
  return html(record_page(record_of(desk), frame), status);
}

Response backup(const Request& request, Desk& desk) {
  try {
    if (desk.database.in_memory()) throw InputError("this record is kept in memory and has no file to copy");
    std::string time = utc_now();
    std::replace(time.begin(), time.end(), ':', '-');
    const bool whole = argument(request.form, "leave") != "recordings";
    back_up(desk.database, desk.database.file().string() + "." + time + ".backup",
            whole ? BackedUp::kWithRecordings : BackedUp::kWithoutRecordings);
  } catch (const InputError& error) {
    return backup_refusal(request, desk, 400, error.what());
  } catch (const DiskFull& error) {
    return backup_refusal(request, desk, 507, error.what());
  } catch (const EnvironmentError& error) {
    return backup_refusal(request, desk, 503, error.what());
  }
  return see("/record#backups");
}

Response audit(const Request& request, Desk& desk) {
  const std::string page = argument(request.query, "page", "1");
  const bool number = !page.empty() && page.size() < 7 &&
                      std::all_of(page.begin(), page.end(), [](char c) { return c >= '0' && c <= '9'; });
  const AuditQuestion asked{argument(request.query, "person"), argument(request.query, "action"),
                            number ? std::stoi(page) : 1};
  return html(audit_page(audit_view(desk.database, asked), frame_of(request, desk)));
}

Response retention(const Request& request, Desk& desk) {
  const RetentionView view = retention_view(desk.database, argument(request.query, "days"), request.now_utc);
  return html(retention_page(view, frame_of(request, desk)), view.problem.empty() ? 200 : 400);
}

Response ask_about_demo(const Request& request, Desk& desk) {
  const Frame frame = frame_of(request, desk);
  return frame.demo_goes ? html(demo_question_page(frame)) : see("/");
}

Response remove_demo(const Request& request, Desk& desk) {
  Frame frame = frame_of(request, desk);
  if (!frame.demo_goes) throw InputError("this desk shows no demo cohort that could be removed");
  try {
    const std::string moved = desk.sources.remove_demo();
    return html(demo_gone_page(frame, moved));
  } catch (const InputError& error) {
    frame.refused = {"demo", error.what(), {}};
    return html(demo_question_page(frame), 400);
  }
}

using AdminPage = Response (*)(const Request&, Desk&);

Route admin_route(const std::string& method, const std::string& path, AdminPage page) {
  return {method, path, Audience::kAdministrators, [page](const Request& request, Desk& desk) {
            return answered(request, desk, 400, [&] { return page(request, desk); });
          }};
}

/// A form's address asked for as a page.
Route admin_form(const std::string& path, const std::string& page) {
  return {"GET", path, Audience::kAdministrators, [page](const Request&, Desk&) { return see(page); }};
}

}  // namespace

std::vector<Route> admin_routes() {
  return {admin_route("GET", "/accounts", accounts),
          admin_route("POST", "/accounts", add_account),
          admin_route("POST", "/accounts/{login}/password", new_password),
          admin_route("POST", "/accounts/{login}/disable",
                      [](const Request& r, Desk& d) { return set_disabled(r, d, true); }),
          admin_route("POST", "/accounts/{login}/enable",
                      [](const Request& r, Desk& d) { return set_disabled(r, d, false); }),
          admin_form("/accounts/{login}/password", "/accounts"),
          admin_form("/accounts/{login}/disable", "/accounts"),
          admin_form("/accounts/{login}/enable", "/accounts"),
          admin_route("GET", "/record", record),
          admin_route("POST", "/record/check", check),
          admin_route("POST", "/record/backup", backup),
          admin_form("/record/check", "/record"),
          admin_form("/record/backup", "/record"),
          admin_route("GET", "/audit", audit),
          admin_route("GET", "/retention", retention),
          admin_route("GET", "/demo/remove", ask_about_demo),
          admin_route("POST", "/demo/remove", remove_demo)};
}

}  // namespace trocar::review
