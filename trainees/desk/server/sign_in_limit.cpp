#include "trainees/desk/server/sign_in_limit.h"

#include <algorithm>
#include <tuple>

namespace trocar::review {
namespace {

/// Logins are the same in any case.
std::string login_key(const std::string& login) {
  constexpr std::size_t kLongest = 64;
  std::string out = "login " + login.substr(0, kLongest);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return out;
}

std::string address_key(const std::string& address) { return "address " + address; }
std::string pair_key(const std::string& login, const std::string& address) {
  return "from " + address + " " + login_key(login);
}

}  // namespace

std::vector<SignInLimit::Counted> SignInLimit::counted(const std::string& login, const std::string& address) const {
  std::vector<Counted> out{{pair_key(login, address), kOfLogin, kFree}, {address_key(address), kOfAddress, kFree}};
  const auto own = own_.find(login_key(login));
  if (own == own_.end() || std::find(own->second.begin(), own->second.end(), address) == own->second.end())
    out.push_back({login_key(login), kOfLogin, kFreeOfLogin, true});
  return out;
}

void SignInLimit::Wrong::forget(DeskTime now) {
  std::erase_if(tries, [&](DeskTime t) { return now - t > memory; });
}

int SignInLimit::wait(const Counted& counted, DeskTime now) {
  const auto at = wrong_.find(counted.key);
  if (at == wrong_.end()) return 0;
  at->second.forget(now);
  const Tries& tries = at->second.tries;
  const int count = static_cast<int>(tries.size());
  if (count < counted.free) return 0;
  constexpr int kMostDoublings = 5;
  const auto pause =
      std::min<std::chrono::seconds>(kFirstWait * (1 << std::min(count - counted.free, kMostDoublings)), kLongestWait);
  const auto left = std::chrono::ceil<std::chrono::seconds>(tries.back() + pause - now);
  return static_cast<int>(std::max<std::chrono::seconds::rep>(left.count(), 0));
}

void SignInLimit::make_room(DeskTime now) {
  if (wrong_.size() < kMostKnown) return;
  for (auto& entry : wrong_) entry.second.forget(now);
  std::erase_if(wrong_, [](const auto& entry) { return entry.second.tries.empty(); });
  if (wrong_.size() <= kMostKnown / 2) return;
  using Place = decltype(wrong_)::iterator;
  std::vector<Place> all;  // half goes, so that this is done seldom
  for (Place at = wrong_.begin(); at != wrong_.end(); ++at) all.push_back(at);
  const auto first_kept = all.begin() + static_cast<std::ptrdiff_t>(all.size() - kMostKnown / 2);
  std::nth_element(all.begin(), first_kept, all.end(), [](Place a, Place b) {
    const auto rank = [](const Wrong& one) { return std::make_tuple(one.stays, one.tries.size(), one.tries.back()); };
    return rank(a->second) < rank(b->second);
  });
  std::for_each(all.begin(), first_kept, [&](Place at) { wrong_.erase(at); });
}

int SignInLimit::begin(const std::string& login, const std::string& address, DeskTime now, bool exists) {
  const std::scoped_lock lock(mutex_);
  const std::vector<Counted> all = counted(login, address);
  int seconds = 0;
  for (const Counted& one : all) seconds = std::max(seconds, wait(one, now));
  if (seconds > 0) return seconds;
  make_room(now);
  for (const Counted& one : all) {
    Wrong& wrong = wrong_[one.key];
    wrong.tries.push_back(now);
    wrong.memory = one.memory;
    wrong.stays = exists && one.of_login;
  }
  return 0;
}

bool SignInLimit::tell_held_back(const std::string& login, const std::string& address, DeskTime now) {
  const std::scoped_lock lock(mutex_);
  const auto full = [&](const Counted& one) {
    const auto at = wrong_.find(one.key);
    return at != wrong_.end() && at->second.tries.size() == static_cast<std::size_t>(one.free);
  };
  std::erase_if(told_, [&](DeskTime t) { return now - t > std::chrono::hours(1); });
  const std::vector<Counted> all = counted(login, address);
  if (told_.size() >= kMostTold || std::none_of(all.begin(), all.end(), full)) return false;
  told_.push_back(now);
  return true;
}

void SignInLimit::was_right(const std::string& login, const std::string& address) {
  const std::scoped_lock lock(mutex_);
  wrong_.erase(pair_key(login, address));
  for (const Counted& one : counted(login, address)) {
    const auto at = wrong_.find(one.key);
    if (at == wrong_.end()) continue;
    Tries& tries = at->second.tries;
    if (!tries.empty()) tries.pop_back();
    if (tries.empty()) wrong_.erase(at);
  }
  std::vector<std::string>& own = own_[login_key(login)];
  std::erase(own, address);
  own.push_back(address);
  if (own.size() > kMostOwn) own.erase(own.begin());
}

}  // namespace trocar::review
