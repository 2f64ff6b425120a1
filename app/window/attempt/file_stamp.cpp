#include "app/window/attempt/file_stamp.h"

#include <ctime>

namespace trocar {

std::string file_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

}  // namespace trocar
