// The pages that are the server's own: signing in, and what went wrong. Pure. Thread: any.
#pragma once

#include <string>

#include "trainees/desk/routes/route.h"

namespace trocar::review {

/// Words for a status: "Not allowed". For any other: "Something went wrong".
std::string status_title(int status);

/// A page that says what went wrong and what to do. @param why one or more sentences, escaped here; empty: the usual
/// one of that status.
/// @param written what the refused form held, given back so that it can be copied; "" for nothing.
Response error_page(int status, const std::string& why = "", const std::string& written = "");

/// What was typed into a form, field after field; never a password.
std::string prose_of(const std::map<std::string, std::string>& form);

/// The disk is full: what the form held, and a button that sends it again; passwords are asked for anew. @param address
/// that it was sent to, and `token` fits.
Response disk_full_page(const std::string& address, const std::string& token,
                        const std::map<std::string, std::string>& form);

struct SignInForm {
  int status = 200;
  std::string message = {};  ///< above the form
  std::string login = {}, next = {}, token = {};
  std::string written = {};  ///< what was being sent when the sign-in was found to have ended
};
Response sign_in_page(const SignInForm& form);

}  // namespace trocar::review
