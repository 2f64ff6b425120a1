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

}  // namespace

int SignInLimit::wait(const std::string& key, std::chrono::seconds memory, DeskTime now) {
  const auto at = wrong_.find(key);
  if (at == wrong_.end()) return 0;
  std::erase_if(at->second, [&](DeskTime t) { return now - t > memory; });
  const int count = static_cast<int>(at->second.size());
  if (count < kFree) return 0;
  constexpr int kMostDoublings = 5;
  const auto pause =
      std::min<std::chrono::seconds>(kFirstWait * (1 << std::min(count - kFree, kMostDoublings)), kLongestWait);
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
  const int seconds = std::max(wait(login_key(login), kOfLogin, now), wait(address_key(address), kOfAddress, now));
  if (seconds > 0) return seconds;
  for (const std::string& key : {login_key(login), address_key(address)}) {
    make_room();
    wrong_[key].push_back(now);
  }
  return 0;
}

bool SignInLimit::tell_held_back(const std::string& login, const std::string& address, DeskTime now) {
  const std::scoped_lock lock(mutex_);
  const auto full = [&](const std::string& key) {
    const auto at = wrong_.find(key);
    return at != wrong_.end() && at->second.size() == static_cast<std::size_t>(kFree);
  };
  std::erase_if(told_, [&](DeskTime t) { return now - t > std::chrono::hours(1); });
  if (told_.size() >= kMostTold || (!full(login_key(login)) && !full(address_key(address)))) return false;
  told_.push_back(now);
  return true;
}

void SignInLimit::was_right(const std::string& login, const std::string& address) {
  const std::scoped_lock lock(mutex_);
  wrong_.erase(login_key(login));
  const auto at = wrong_.find(address_key(address));
  if (at == wrong_.end()) return;
  if (!at->second.empty()) at->second.pop_back();
  if (at->second.empty()) wrong_.erase(at);
}

}  // namespace trocar::review
