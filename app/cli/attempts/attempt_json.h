// The outcome of an attempt as JSON: what `trocar run --json` prints. Numbers that are not finite become null.
#pragma once

#include <string>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/rubric.h"

namespace trocar {

/// One JSON object, indented, with a closing newline. What differs between two equal runs (identifier, time, path)
/// stands under "attempt" alone, so that two outputs can be compared without it.
std::string attempt_json(const AttemptResult& result);

/// Sub-scores with weights and anchors, caps and pass marks, as they hold at a level. One JSON object, indented.
std::string rubric_json(const Rubric& rubric);

}  // namespace trocar
