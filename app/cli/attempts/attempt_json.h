// The outcome of an attempt as JSON: what `trocar run --json` prints. Numbers that are not finite become null.
#pragma once

#include <string>

#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// One JSON object, indented, with a closing newline. What differs between two equal runs (identifier, time, path)
/// stands under "attempt" alone, so that two outputs can be compared without it.
std::string attempt_json(const AttemptResult& result);

}  // namespace trocar
