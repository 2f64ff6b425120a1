#include "trainees/desk/server/sign_in_limit.h"

#include <algorithm>

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
    out.push_back({login_key(login), kOfLogin, kFreeOfLogin});
  return out;
}

int SignInLimit::wait(const Counted& counted, DeskTime now) {
  const auto at = wrong_.find(counted.key);
  if (at == wrong_.end()) return 0;
  std::erase_if(at->second, [&](DeskTime t) { return now - t > counted.memory; });
  const int count = static_cast<int>(at->second.size());
  if (count < counted.free) return 0;
  constexpr int kMostDoublings = 5;
  const auto pause =
      std::min<std::chrono::seconds>(kFirstWait * (1 << std::min(count - counted.free, kMostDoublings)), kLongestWait);
  const auto left = std::chrono::ceil<std::chrono::seconds>(at->second.back() + pause - now);
  return static_cast<int>(std::max<std::chrono::seconds::rep>(left.count(), 0));
}

void SignInLimit::make_room() {
  if (wrong_.size() < kMostKnown) return;
  std::erase_if(wrong_, [](const auto& entry) { return entry.second.empty(); });
  std::vector<DeskTime> newest;  // the older half goes, so that this is done seldom
  for (const auto& entry : wrong_) newest.push_back(entry.second.back());
  const auto middle = newest.begin() + static_cast<std::ptrdiff_t>(newest.size() / 2);
  std::nth_element(newest.begin(), middle, newest.end());
  std::erase_if(wrong_, [&](const auto& entry) { return entry.second.back() <= *middle; });
}

int SignInLimit::begin(const std::string& login, const std::string& address, DeskTime now) {
  const std::scoped_lock lock(mutex_);
  const std::vector<Counted> all = counted(login, address);
  int seconds = 0;
  for (const Counted& one : all) seconds = std::max(seconds, wait(one, now));
  if (seconds > 0) return seconds;
  for (const Counted& one : all) {
    make_room();
    wrong_[one.key].push_back(now);
  }
  return 0;
}

bool SignInLimit::tell_held_back(const std::string& login, const std::string& address, DeskTime now) {
  const std::scoped_lock lock(mutex_);
  const auto full = [&](const Counted& one) {
    const auto at = wrong_.find(one.key);
    return at != wrong_.end() && at->second.size() == static_cast<std::size_t>(one.free);
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
    if (!at->second.empty()) at->second.pop_back();
    if (at->second.empty()) wrong_.erase(at);
  }
  std::vector<std::string>& own = own_[login_key(login)];
  std::erase(own, address);
  own.push_back(address);
  if (own.size() > kMostOwn) own.erase(own.begin());
}

}  // namespace trocar::review
