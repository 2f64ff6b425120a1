#include "trainees/desk/pages/pages.h"
#include "trainees/desk/queries/record_views.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

constexpr const char* kPasswordField =
    "type=\"password\" maxlength=\"1024\" required=\"required\" autocomplete=\"new-password\"";

std::string account_path(const Account& account, const char* action) {
  return "/accounts/" + url_part(account.login) + "/" + action;
}

std::string password_form(const Account& account, const Frame& frame) {
  const std::string form = "password-" + account.login, id = "p-" + url_part(account.login);
  return std::string("<details") + (frame.refused.form == form ? " open=\"open\"" : "") +
         "><summary>New password<span class=\"unseen\"> for " + verbatim(account.login) + "</span></summary>" +
         form_begin(account_path(account, "password"), frame) +
         text_field(
             id, "password",
             account.role == Role::kTrainee ? "Password, or PIN of 6 digits" : "Password, at least 10 characters", "",
             kPasswordField + refused_field(frame, form)) +
         why_refused(frame, form) + "<p><button>Set it</button></p></form></details>";
}

std::string switch_form(const Account& account, const Frame& frame) {
  const bool disabled = !account.disabled_utc.empty();
  return form_begin(account_path(account, disabled ? "enable" : "disable"), frame) + "<button class=\"small\">" +
         (disabled ? "Enable" : "Disable") + "<span class=\"unseen\" translate=\"no\"> " + escape_html(account.login) +
         "</span></button></form>" + why_refused(frame, "switch-" + account.login);
}

std::string row(const Account& account, const AccountsView& view, const Frame& frame) {
  const bool disabled = !account.disabled_utc.empty();
  return "<tr><th scope=\"row\">" + verbatim(account.login) +
         (account.login == view.own_login ? " <span class=\"tag\">you</span>" : "") + "</th>" +
         verbatim_cell(account.name) + cell(role_name(account.role)) + "<td>" +
         (account.trainee_code.empty()
              ? ""
              : verbatim_link("/trainee/" + url_part(account.trainee_code), account.trainee_code)) +
         "</td><td>" + day_html(account.created_utc) + "</td><td>" + shape(disabled ? "fail" : "pass") +
         (disabled ? "disabled " : "may sign in") + (disabled ? day_html(account.disabled_utc) : "") + "</td><td>" +
         switch_form(account, frame) + password_form(account, frame) + "</td></tr>";
}

std::string new_account(const AccountsView& view, const Frame& frame) {
  std::vector<std::pair<std::string, std::string>> roles, codes = {{"", "nobody: staff"}};
  if (!view.first) roles = {{"trainee", "trainee"}, {"instructor", "instructor"}};
  roles.emplace_back("administrator", "administrator");
  for (const std::string& code : view.without) codes.emplace_back(code, code);
  const std::string form = "account";
  return (view.first ? "<p class=\"warning\">" + shape("integrity") +
                           "Nobody signs in here yet. The first account is an administrator's, best your own: from "
                           "then on everybody signs "
                           "in, you too.</p>"
                     : std::string()) +
         form_begin("/accounts", frame) + "<div class=\"fields\">" +
         text_field("a-login", "login", "Login", kept(frame, form, "login"),
                    "maxlength=\"32\" required=\"required\" autocomplete=\"off\" autocapitalize=\"none\"" +
                        refused_field(frame, form)) +
         text_field("a-name", "name", "Name, as it is printed", kept(frame, form, "name"),
                    "maxlength=\"100\" autocomplete=\"off\"") +
         select_field("a-role", "role", "Role", roles, kept(frame, form, "role")) +
         (view.first
              ? std::string()
              : select_field("a-trainee", "trainee", "Of the trainee", codes, kept(frame, form, "trainee"), true)) +
         text_field("a-password", "password", "Password (of a trainee: or a PIN of 6 digits)", "", kPasswordField) +
         text_field("a-again", "again", "Password again", "", kPasswordField) + "</div>" + why_refused(frame, form) +
         "<p><button>Add the account</button></p></form>";
}

}  // namespace

std::string password_page(bool trainee, Frame frame) {
  frame.title = "Your password";
  const std::string form = "password";
  return document(
      frame,
      "<div class=\"title\"><h1>Your password</h1></div>" +
          section("password", "Set your own password",
                  form_begin("/password", frame) + "<div class=\"fields\">" +
                      text_field("present", "password", trainee ? "Present password or PIN" : "Present password", "",
                                 "type=\"password\" maxlength=\"1024\" required=\"required\" "
                                 "autocomplete=\"current-password\"") +
                      text_field("fresh", "fresh",
                                 trainee ? "New password, or PIN of 6 digits" : "New password, at least 10 characters",
                                 "", kPasswordField + refused_field(frame, form)) +
                      text_field("again", "again", "New one again", "", kPasswordField) + "</div>" +
                      why_refused(frame, form) +
                      "<p><button>Set it</button></p></form><p class=\"dim\">Nobody can read it back. What repeats "
                      "itself, sequences, the login and the most common ones are refused. It ends your sign-ins "
                      "elsewhere.</p>"));
}

std::string accounts_page(const AccountsView& view, Frame frame) {
  frame.title = "Accounts";
  std::string rows;
  for (const Account& account : view.accounts) rows += row(account, view, frame);
  const std::string listed =
      rows.empty() ? "<p>None yet: the desk is open to the person who started it, on this machine alone.</p>"
                   : table("Who may sign in. Nobody can read a password back; a new one ends the sign-ins of the old.",
                           head_cells({"Login", "Name", "Role", "Trainee", "Made", "State", "Change"}), rows);
  return document(frame, "<div class=\"title\"><h1>Accounts</h1></div>" + section("accounts", "Accounts", listed) +
                             section("new", "New account", new_account(view, frame)));
}

}  // namespace trocar::review
