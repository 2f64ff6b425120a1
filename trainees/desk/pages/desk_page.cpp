#include "trainees/desk/pages/desk_page.h"

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

std::string prose_of(const std::map<std::string, std::string>& form) {
  std::string out;
  for (const char* field : {"text", "note", "reason", "toml"}) {
    const auto it = form.find(field);
    if (it != form.end() && !it->second.empty()) out += (out.empty() ? "" : "\n\n") + it->second;
  }
  return out;
}

Response error_page(int status, const std::string& why, const std::string& written) {
  Response out;
  out.status = status;
  const std::string title = status_title(status);
  out.body = document(title, "<h1>" + escape_html(title) + "</h1>\n<p class=\"error\">" +
                                 escape_html(why.empty() ? usual_words(status) : why) + "</p>\n" + given_back(written) +
                                 "<p><a href=\"/\">To the first page</a> <span class=\"quiet\">(" +
                                 std::to_string(status) + ")</span></p>\n");
  return out;
}

Response sign_in_page(const SignInForm& form) {
  Response out;
  out.status = form.status;
  const auto hidden = [](const char* name, const std::string& value) {
    return std::string("<input type=\"hidden\" name=\"") + name + "\" value=\"" + escape_html(value) + "\">\n";
  };
  std::string body = "<h1>Trocar: sign in</h1>\n";
  if (!form.message.empty()) body += "<p class=\"error\" role=\"alert\">" + escape_html(form.message) + "</p>\n";
  body += given_back(form.written) + "<form method=\"post\" action=\"/sign-in\">\n" + hidden("token", form.token) +
          hidden("next", form.next) +
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
