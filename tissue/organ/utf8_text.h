// Whether bytes are text as UTF-8 has it: what a TOML file must hold.
//
// Source: Unicode 15, table 3-7 (no surrogates, no overlong forms). Pure. Thread: any.
#pragma once

#include <string_view>

namespace trocar {

bool is_utf8(std::string_view text);

}  // namespace trocar
