// Keys that stand twice in one object of a JSON text: a reader would silently take one of the two values. Thread: any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trocar {

/// In order of appearance; of a text that is no JSON those before its fault.
std::vector<std::string> doubled_keys(std::string_view json);

}  // namespace trocar
