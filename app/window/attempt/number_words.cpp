#include "app/window/attempt/number_words.h"

#include <cmath>
#include <numbers>

namespace trocar {

std::string brief(const Translator& w, double value) {
  for (const int decimals : {0, 1, 2}) {
    const double scale = std::pow(10, decimals);
    if (std::abs(std::round(value * scale) / scale - value) < 1e-9) return w.number(value, decimals);
  }
  return w.number(value, 2);
}

std::string newtons(const Translator& w, double n) { return w("{0} N", {brief(w, n)}); }
std::string newtons_between(const Translator& w, double low, double high) {
  return w("{0} to {1} N", {brief(w, low), brief(w, high)});
}
std::string millimetres(const Translator& w, double m) { return w("{0} mm", {brief(w, 1e3 * m)}); }
std::string degrees(const Translator& w, double rad) {
  return w("{0} degrees", {brief(w, std::round(rad * 1800 / std::numbers::pi) / 10)});
}

}  // namespace trocar
