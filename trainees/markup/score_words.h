// Parts of a score in words: their values with a unit that a reader knows, and what a safety gate asks.
//
// Returns plain text. Thread: any.
#pragma once

#include <optional>
#include <string>

#include "scenarios/scoring/attempt_result.h"

namespace trocar {

/// A value of the part's metric: "63 %" of a share, "1.6 mm", "\xE2\x80\x93" of nothing. A metric without unit is a
/// share where its anchors lie within 0 and 1 and value or anchors are broken numbers; else a count.
std::string part_value_text(const Subscore& part, const std::optional<double>& value);
/// "full at 100 %, none at 30 %".
std::string anchors_text(const Subscore& part);
/// "force in band 63 %, the gate asks 65 % or more". @param below share of the part that meets the gate (Cap::below).
std::string gate_text(const Subscore& part, double below);
/// cap_sentence(), with gate_text() where it is of a gate: "safety gate: force in band 63 %, the gate asks 65 % or
/// more: at most 59".
std::string cap_text(const Grade& grade, const Cap& cap);

}  // namespace trocar
