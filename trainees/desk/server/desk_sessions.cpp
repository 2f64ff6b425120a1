#include "trainees/desk/server/desk_sessions.h"

#include <sodium.h>

#include <algorithm>

#include "haptics/input_error.h"

namespace trocar::review {
namespace {

constexpr int kVariant = sodium_base64_VARIANT_URLSAFE_NO_PADDING;
constexpr std::size_t kBytes = 32, kLetters = 43;

std::string letters_of(const unsigned char* bytes, std::size_t count) {
  std::string out(sodium_base64_ENCODED_LEN(count, kVariant), '\0');
  sodium_bin2base64(out.data(), out.size(), bytes, count, kVariant);
  out.resize(out.size() - 1);  // the zero at its end
  return out;
}

}  // namespace

DeskSessions::DeskSessions(const SessionLimits& limits) : limits_(limits) {
  if (sodium_init() < 0) throw EnvironmentError("the machine gives no random numbers: nobody can sign in");
  randombytes_buf(session_key_.data(), session_key_.size());
  randombytes_buf(token_key_.data(), token_key_.size());
}

std::string DeskSessions::fresh_number() {
  std::array<unsigned char, kBytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  return letters_of(bytes.data(), bytes.size());
}

bool DeskSessions::is_number(const std::string& text) {
  return text.size() == kLetters && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_';
         });
}

std::string DeskSessions::digest(const Key& key, const std::string& number) const {
  std::array<unsigned char, kBytes> out{};
  crypto_generichash(out.data(), out.size(), reinterpret_cast<const unsigned char*>(number.data()), number.size(),
                     key.data(), key.size());
  return letters_of(out.data(), out.size());
}

bool DeskSessions::over(const Kept& kept, DeskTime now) const {
  return now - kept.used > limits_.idle || now - kept.begun > limits_.most;
}

void DeskSessions::make_room(const std::string& account, DeskTime now) {
  std::erase_if(sessions_, [&](const auto& entry) { return over(entry.second, now); });
  const auto drop_oldest = [&](std::size_t most, const auto& counts) {
    if (static_cast<std::size_t>(std::count_if(sessions_.begin(), sessions_.end(), counts)) < most) return;
    auto oldest = sessions_.end();
    for (auto it = sessions_.begin(); it != sessions_.end(); ++it) {
      if (counts(*it) && (oldest == sessions_.end() || it->second.used < oldest->second.used)) oldest = it;
    }
    if (oldest != sessions_.end()) sessions_.erase(oldest);
  };
  drop_oldest(limits_.of_account, [&](const auto& entry) { return entry.second.session.account == account; });
  drop_oldest(limits_.of_all, [](const auto&) { return true; });
}

std::string DeskSessions::begin(const Session& session, DeskTime now) {
  const std::string number = fresh_number();
  const std::scoped_lock lock(mutex_);
  make_room(session.account, now);
  sessions_[digest(session_key_, number)] = {session, now, now};
  return number;
}

std::optional<Session> DeskSessions::find(const std::string& number, DeskTime now) {
  if (!is_number(number)) return {};
  const std::string key = digest(session_key_, number);
  const std::scoped_lock lock(mutex_);
  const auto at = sessions_.find(key);
  if (at == sessions_.end()) return {};
  if (over(at->second, now)) {
    sessions_.erase(at);
    return {};
  }
  at->second.used = now;
  return at->second.session;
}

std::string DeskSessions::account(const std::string& number) const {
  if (!is_number(number)) return "";
  const std::string key = digest(session_key_, number);
  const std::scoped_lock lock(mutex_);
  const auto at = sessions_.find(key);
  return at == sessions_.end() ? "" : at->second.session.account;
}

void DeskSessions::end(const std::string& number) {
  const std::string key = digest(session_key_, number);
  const std::scoped_lock lock(mutex_);
  sessions_.erase(key);
}

void DeskSessions::mark_recorded(const std::string& number) {
  const std::string key = digest(session_key_, number);
  const std::scoped_lock lock(mutex_);
  if (const auto at = sessions_.find(key); at != sessions_.end()) at->second.session.recorded = true;
}

std::size_t DeskSessions::count() const {
  const std::scoped_lock lock(mutex_);
  return sessions_.size();
}

std::string DeskSessions::token(const std::string& number) const { return digest(token_key_, number); }

bool DeskSessions::token_fits(const std::string& number, const std::string& token) const {
  const std::string wanted = this->token(number);
  return token.size() == wanted.size() && sodium_memcmp(token.data(), wanted.data(), wanted.size()) == 0;
}

}  // namespace trocar::review
