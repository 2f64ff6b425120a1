// The pages that are the server's own: signing in, and what went wrong. Pure. Thread: any.
#pragma once

#include <string>

#include "trainees/review/route.h"

namespace trocar::review {

/// Words for a status: "Not allowed". For any other: "Something went wrong".
std::string status_title(int status);

/// A page that says what went wrong and what to do. @param why one or more sentences, escaped here; empty: the usual one of that status.
Response error_page(int status, const std::string& why = "");

struct SignInForm {
  int status = 200;
  std::string message = {};   ///< above the form
  std::string login = {}, next = {}, token = {};
};
Response sign_in_page(const SignInForm& form);

}  // namespace trocar::review
