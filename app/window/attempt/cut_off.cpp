#include "app/window/attempt/cut_off.h"

#include <array>
#include <ctime>

namespace trocar {

std::string local_time(const std::string& utc, long long now) {
  std::tm parts = {};
  if (::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &parts) == nullptr) return utc;
  const std::time_t then = ::timegm(&parts), today = static_cast<std::time_t>(now);
  std::tm then_here = {}, now_here = {};
  ::localtime_r(&then, &then_here);
  ::localtime_r(&today, &now_here);
  const bool same_day = then_here.tm_year == now_here.tm_year && then_here.tm_yday == now_here.tm_yday;
  std::array<char, 32> text = {};
  std::strftime(text.data(), text.size(), same_day ? "%H:%M" : "%Y-%m-%d %H:%M", &then_here);
  return text.data();
}

std::string cut_off_words(const Translator& words, const std::string& name, const AttemptSummary& attempt,
                          long long now) {
  const std::string at = local_time(attempt.started_utc, now);
  return words("The attempt of {0} at {1} was cut off; it is kept as aborted and its recording can be seen.",
               {name, at});
}

}  // namespace trocar
