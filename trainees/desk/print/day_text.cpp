#include <array>
#include <cstdlib>

#include "trainees/desk/print/report.h"

namespace trocar::printed {

std::string day_text(const std::string& utc) {
  constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  if (utc.size() < 10 || utc[4] != '-' || utc[7] != '-') return utc;
  for (const std::size_t i : {0U, 1U, 2U, 3U, 5U, 6U, 8U, 9U})
    if (utc[i] < '0' || utc[i] > '9') return utc;
  const int month = std::atoi(utc.substr(5, 2).c_str());
  if (month < 1 || month > 12) return utc;
  return std::to_string(std::atoi(utc.substr(8, 2).c_str())) + " " + kMonths.at(static_cast<std::size_t>(month - 1)) +
         " " + utc.substr(0, 4);
}

}  // namespace trocar::printed
