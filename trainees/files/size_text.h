// How large something on a disk is, for people. Thread: any.
#pragma once

#include <cstdint>
#include <string>

namespace trocar {

/// "1.2 MB", decimal.
std::string size_text(std::uintmax_t bytes);

}  // namespace trocar
