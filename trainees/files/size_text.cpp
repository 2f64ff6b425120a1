#include "trainees/files/size_text.h"

#include <cstdio>

namespace trocar {

std::string size_text(std::uintmax_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value < 1e3) return std::to_string(bytes) + " B";
  char text[40];
  if (value < 1e6)
    std::snprintf(text, sizeof text, "%.1f kB", value / 1e3);
  else if (value < 1e9)
    std::snprintf(text, sizeof text, "%.1f MB", value / 1e6);
  else
    std::snprintf(text, sizeof text, "%.2f GB", value / 1e9);
  return text;
}

}  // namespace trocar
