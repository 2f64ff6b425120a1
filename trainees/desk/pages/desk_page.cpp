#include "trainees/desk/pages/desk_page.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, "
         "initial-scale=1\">"
         "<title>" +
         escape_html(title) +
         " - Trocar</title><link rel=\"icon\" href=\"/icon.svg\"><link rel=\"stylesheet\" href=\"/style.css\"></head>\n"
         "<body class=\"plain\"><main>\n" +
         body + "</main><footer>" + language_links({}) + "</footer></body></html>\n";
}

std::string given_back(const std::string& written) {
  if (written.empty()) return "";
  return "<p>What you had written, to copy:</p>\n<pre class=\"written\">" + escape_html(written) + "</pre>\n";
}

/// Fields that are typed anew whenever their form comes back.
constexpr std::array<std::string_view, 3> kSecret = {"again", "fresh", "password"};

bool is_secret(const std::string& field) { return std::find(kSecret.begin(), kSecret.end(), field) != kSecret.end(); }

std::string secret_words(const std::string& field) {
  return field == "again" ? "Password again" : field == "fresh" ? "New password" : "Password";
}

std::string hidden_field(const std::string& name, const std::string& value) {
  return "<input type=\"hidden\" name=\"" + escape_html(name) + "\" value=\"" + escape_html(value) + "\">\n";
}

std::string usual_words(int status) {
  switch (status) {
    case 400:
      return "The request cannot be read. Go back and open the page again.";
    case 401:
      return "Sign in to see this page.";
    case 403:
      return "Your account may not see or do this.";
    case 404:
      return "There is no such page. It may have been moved, or the address was mistyped.";
    case 405:
      return "This page cannot be used in that way.";
    case 408:
      return "The request took too long to arrive. Try again.";
    case 413:
      return "What was sent is too large: at most 1 MB is taken.";
    case 421:
      return "This desk does not go by that name. Use the address that it printed when it was started.";
    case 429:
      return "Too many tries. Wait, then try again.";
    case 500:
      return "Something went wrong in the program; what, stands on the terminal of the desk. Look whether what you did "
             "is there.";
    case 503:
      return "The desk is busy. Try again in a moment.";
    case 507:
      return "The disk of this machine is full: nothing was written. Make room on it, then send it again. All that is "
             "there can be read on.";
    default:
      return "The request cannot be answered.";
  }
}

}  // namespace

std::string status_title(int status) {
  switch (status) {
    case 400:
      return "Not understood";
    case 401:
      return "Sign in";
    case 403:
      return "Not allowed";
    case 404:
      return "Not found";
    case 405:
      return "Not possible here";
    case 408:
      return "Too slow";
    case 411:
      return "Length missing";
    case 413:
      return "Too large";
    case 414:
      return "Address too long";
    case 415:
      return "Not readable here";
    case 421:
      return "Wrong name";
    case 429:
      return "Too many tries";
    case 431:
      return "Head too large";
    case 503:
      return "Busy";
    case 507:
      return "The disk is full";
    case 505:
      return "Other protocol";
    default:
      return "Something went wrong";
  }
}

namespace {
std::string page_body(int status, const std::string& why, const std::string& inner_html) {
  return document(status_title(status), "<h1>" + escape_html(status_title(status)) + "</h1>\n<p class=\"error\">" +
                                            escape_html(why.empty() ? usual_words(status) : why) + "</p>\n" +
                                            inner_html +
                                            "<p><a href=\"/\">To the first page</a> <span class=\"quiet\">(" +
                                            std::to_string(status) + ")</span></p>\n");
}
}  // namespace

std::string prose_of(const std::map<std::string, std::string>& form) {
  std::vector<std::pair<std::string, std::string>> typed;
  for (const auto& [name, value] : form)
    if (!value.empty() && name != "do" && name != "token" && !is_secret(name)) typed.emplace_back(name, value);
  if (typed.size() == 1) return typed.front().second;
  std::string out;
  for (const auto& [name, value] : typed) {
    const bool many_lines = value.find('\n') != std::string::npos;
    out += (out.empty() ? "" : "\n") + name + (many_lines ? ":\n" : ": ") + value;
  }
  return out;
}

Response error_page(int status, const std::string& why, const std::string& written) {
  return {.status = status, .body = page_body(status, why, given_back(written))};
}

Response disk_full_page(const std::string& address, const std::string& token,
                        const std::map<std::string, std::string>& form) {
  std::string fields = hidden_field("token", token), asked;
  for (const auto& [name, value] : form) {
    if (is_secret(name))
      asked += "<p><label>" + secret_words(name) + "<br><input name=\"" + name +
               "\" type=\"password\" maxlength=\"1024\" autocomplete=\"off\" required></label></p>\n";
    else
      fields += hidden_field(name, value);
  }
  return {.status = 507,
          .body = page_body(507, "",
                            given_back(prose_of(form)) + "<form method=\"post\" action=\"" + escape_html(address) +
                                "\">\n" + fields + asked +
                                "<p><button type=\"submit\">Send again</button></p>\n</form>\n")};
}

Response sign_in_page(const SignInForm& form) {
  Response out;
  out.status = form.status;
  std::string body = "<h1>Trocar: sign in</h1>\n";
  if (!form.message.empty()) body += "<p class=\"error\" role=\"alert\">" + escape_html(form.message) + "</p>\n";
  body += given_back(form.written) + "<form method=\"post\" action=\"/sign-in\">\n" +
          hidden_field("token", form.token) + hidden_field("next", form.next) +
          "<p><label>Login<br><input name=\"login\" maxlength=\"32\" autocomplete=\"username\" autocapitalize=\"none\" "
          "required autofocus "
          "value=\"" +
          escape_html(form.login) +
          "\"></label></p>\n"
          "<p><label>Password or PIN<br><input name=\"password\" type=\"password\" maxlength=\"1024\" "
          "autocomplete=\"current-password\" "
          "required></label></p>\n"
          "<p><button type=\"submit\">Sign in</button></p>\n</form>\n"
          "<p class=\"quiet\">No account, or the password is lost? An administrator makes a new one.</p>\n";
  out.body = document("Sign in", body);
  return out;
}

}  // namespace trocar::review
