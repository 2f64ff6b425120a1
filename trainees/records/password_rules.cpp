#include "trainees/records/password_rules.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::size_t kShortestPassword = 10, kLongestPassword = 1024, kPinDigits = 6;

/// Neighbours on keyboards (US, German, French), in the alphabet and among digits; read backwards too.
constexpr std::string_view kRuns[] = {"01234567890123456789",
                                      "abcdefghijklmnopqrstuvwxyz",
                                      "qwertyuiop",
                                      "qwertzuiop",
                                      "azertyuiop",
                                      "asdfghjkl",
                                      "zxcvbnm",
                                      "yxcvbnm"};

/// What leaked lists have most of, at these lengths; what only adds digits or signs to one is found by common_with().
constexpr std::string_view kCommon[] = {
    "password", "passwort",      "motdepasse", "letmein", "welcome",    "willkommen", "iloveyou",    "trustno1",
    "dragon",   "administrator", "instructor", "trocar",  "1q2w3e4r5t", "changeme",   "laparoscopy", "simulator"};
/// Ways over the keys of a number pad, and steps by two.
constexpr std::string_view kCommonPins[] = {"112233", "123321", "159753", "753159", "357159", "159357", "951357",
                                            "147258", "258147", "258369", "369258", "147369", "741852", "852741",
                                            "852963", "963852", "789456", "456123", "246810", "135790", "102030"};

bool digit(char c) { return c >= '0' && c <= '9'; }

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

bool few_characters(const std::string& text) { return std::set<char>(text.begin(), text.end()).size() <= 2; }

/// "abcabcabc": one part of at most half the length, over and over.
bool repeated(const std::string& text) {
  for (std::size_t part = 1; 2 * part <= text.size(); ++part)
    if (text.substr(part) == text.substr(0, text.size() - part)) return true;
  return false;
}

/// Made of runs of neighbours of at least 3, up or down: "123456", "qwertz1234", "abcdef654321".
bool of_neighbours(const std::string& text) {
  constexpr std::size_t kLeast = 3;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t longest = 0;
    for (const std::string_view run : kRuns) {
      for (const std::string& way : {std::string(run), std::string(run.rbegin(), run.rend())}) {
        for (std::size_t length = std::min(way.size(), text.size() - at); length >= kLeast && length > longest;
             --length)
          if (way.find(text.substr(at, length)) != std::string::npos) longest = length;
      }
    }
    if (longest == 0) return false;
    at += longest;
  }
  return true;
}

bool letter(char c) { return c >= 'a' && c <= 'z'; }

/// At most 4 characters that are no letters: what people add to a word.
bool little(const std::string& rest) {
  constexpr std::size_t kMost = 4;
  return rest.size() <= kMost && std::none_of(rest.begin(), rest.end(), letter);
}

/// The word, and little before and behind it.
bool common_with(const std::string& text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (word.empty() || at == std::string::npos) return false;
  return little(text.substr(0, at) + text.substr(at + word.size()));
}

/// The parts of a login ("ines" and "brandt" of ines.brandt) in any order, and little besides.
bool of_parts(std::string text, const std::string& login) {
  constexpr std::size_t kLeast = 3;
  bool found = false;
  for (auto at = login.begin(); at != login.end();) {
    const auto begin = std::find_if(at, login.end(), letter), end = std::find_if_not(begin, login.end(), letter);
    at = end;
    const std::string part(begin, end);
    const std::size_t place = part.size() < kLeast ? std::string::npos : text.find(part);
    if (place == std::string::npos) continue;
    text.erase(place, part.size());
    found = true;
  }
  return found && little(text);
}

bool listed(const std::string& text, bool pin) {
  if (pin) return std::find(std::begin(kCommonPins), std::end(kCommonPins), text) != std::end(kCommonPins);
  return std::any_of(std::begin(kCommon), std::end(kCommon),
                     [&](std::string_view word) { return common_with(text, word); });
}

}  // namespace

bool looks_like_pin(const std::string& given) {
  return !given.empty() && given.size() < kShortestPassword && std::all_of(given.begin(), given.end(), digit);
}

void check_password(const std::string& password, Role role, const std::string& login) {
  if (password.size() > kLongestPassword) throw InputError("password: give no more than 1024 characters");
  const auto characters =
      std::count_if(password.begin(), password.end(), [](char c) { return (c & 0xC0) != 0x80; });  // of UTF-8
  const bool pin =
      role == Role::kTrainee && password.size() == kPinDigits && std::all_of(password.begin(), password.end(), digit);
  if (!pin && static_cast<std::size_t>(characters) < kShortestPassword)
    throw InputError(role == Role::kTrainee ? "password: give at least 10 characters, or a PIN of 6 digits"
                                            : "password: give at least 10 characters");
  const std::string name = pin ? "PIN" : "password", text = lower(password), own = lower(login);
  if (few_characters(text) || repeated(text))
    throw InputError(name + ": this one repeats itself, and is guessed first; take another");
  if (of_neighbours(text)) throw InputError(name + ": this one is a sequence, and is guessed first; take another");
  if (text == own || common_with(text, own) || of_parts(text, own) || text == std::string(own.rbegin(), own.rend()))
    throw InputError(name + ": this one is the login, and is guessed first; take another");
  if (listed(text, pin))
    throw InputError(name + ": this one is among the most common, and is guessed first; take another");
}

}  // namespace trocar
