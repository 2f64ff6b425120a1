// Passivity laws of others, for comparison with the loop's own (`trocar study passivity`).
//
//   thesis     W = sum f(k) dx(k) (4.17), f + alpha v with alpha = -W / (T v^2), unbounded (4.18)
//   reference  full spring plus damping alpha = min(alpha_max, -B / (T v^2)), B what was absorbed less what the full
//              spring stores (Ryu, Preusche, Hannaford and Hirzinger 2005, with the bound of docs/device.md)
//   cap        the spring weakened to what damping supports, b / (T/2 + Td)
// A law is a function of one scalar contact that keeps its own state; a copy goes on by itself. SI. Thread: one owner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "haptics/control/passivity.h"

namespace trocar {

enum class ComparisonLaw : std::uint8_t { kThesis, kReference, kCap };
inline constexpr std::array kComparisonLaws{ComparisonLaw::kThesis, ComparisonLaw::kReference, ComparisonLaw::kCap};
constexpr const char* comparison_law_name(ComparisonLaw law) {
  constexpr std::array kNames{"thesis", "reference", "cap"};
  return kNames[static_cast<std::size_t>(law)];
}

/// @param seam period and delay.
std::function<double(const ContactWork&)> comparison_law(ComparisonLaw law, const PassivityParameters& seam);

}  // namespace trocar
