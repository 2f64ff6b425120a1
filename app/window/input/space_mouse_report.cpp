#include "app/window/input/space_mouse_report.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kFullScale = 350;
constexpr std::uint16_t kLogitech = 0x046d, k3Dconnexion = 0x256f, kMultiAxis = 8;

double axis_at(std::span<const std::uint8_t> report, std::size_t at) {
  const auto raw = static_cast<std::int16_t>(report[at] | (report[at + 1] << 8));
  return std::clamp(raw / kFullScale, -1.0, 1.0);
}

void take_vector(std::span<const std::uint8_t> report, std::size_t at, double* xyz) {
  xyz[0] = axis_at(report, at);
  xyz[1] = -axis_at(report, at + 4);
  xyz[2] = axis_at(report, at + 2);
}

}  // namespace

bool apply_space_mouse_report(std::span<const std::uint8_t> report, SpaceMouseState& state) {
  if (report.size() < 2) return false;
  switch (report[0]) {
    case 1:
      if (report.size() < 7) return false;
      take_vector(report, 1, state.axis.data());
      if (report.size() >= 13) take_vector(report, 7, state.axis.data() + 3);
      return true;
    case 2:
      if (report.size() < 7) return false;
      take_vector(report, 1, state.axis.data() + 3);
      return true;
    case 3:
      state.buttons = 0;
      for (std::size_t i = 1; i < std::min<std::size_t>(report.size(), 5); ++i)
        state.buttons |= static_cast<std::uint32_t>(report[i]) << (8 * (i - 1));
      return true;
    default:
      return false;
  }
}

bool is_space_mouse(std::uint16_t vendor, std::uint16_t product, std::uint16_t usage_page, std::uint16_t usage) {
  const bool told = usage_page != 0;
  if (told && (usage_page != 1 || usage != kMultiAxis)) return false;
  if (vendor == k3Dconnexion) return true;
  return vendor == kLogitech && product >= 0xc603 && product <= 0xc62b;
}

}  // namespace trocar
