#include "app/desk/password_prompt.h"

#include <termios.h>
#include <unistd.h>

#include <iostream>

#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Letters are not shown while it lives.
class Unseen {
 public:
  Unseen() : changed_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!changed_) return;
    termios now = before_;
    now.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &now);
  }
  ~Unseen() {
    if (changed_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;

 private:
  termios before_{};
  bool changed_;
};

std::string line_of(std::istream& in, const std::string& login) {
  std::string line;
  if (!std::getline(in, line))
    throw InputError("account " + login + ": no password came in; type it, or give it as first line of the input");
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

std::string present_password(const std::string& login, std::istream& in, std::ostream& err) {
  if (&in != &std::cin || ::isatty(STDIN_FILENO) == 0) return line_of(in, login);
  const Unseen unseen;
  err << "Present password of " << login << ": " << std::flush;
  const std::string present = line_of(in, login);
  err << '\n';
  return present;
}

std::string new_password(const std::string& login, std::istream& in, std::ostream& err) {
  if (&in != &std::cin || ::isatty(STDIN_FILENO) == 0) return line_of(in, login);
  const Unseen unseen;
  err << "Password of " << login << ": " << std::flush;
  const std::string first = line_of(in, login);
  err << "\nOnce more: " << std::flush;
  const std::string second = line_of(in, login);
  err << '\n';
  if (first != second) throw InputError("account " + login + ": the two passwords differ; nothing was changed");
  return first;
}

}  // namespace trocar
