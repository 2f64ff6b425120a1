#include "trainees/markup/score_words.h"

#include <cmath>

#include "trainees/markup/html.h"

namespace trocar {
namespace {

bool within_one(double value) { return value >= 0 && value <= 1; }
bool whole(double value) { return value == std::floor(value); }

bool is_share(const Subscore& part) {
  return readable_unit(0, part.unit).second.empty() && within_one(part.full_at) && within_one(part.zero_at) &&
         !(whole(part.full_at) && whole(part.zero_at) && whole(part.raw.value_or(0)));
}

}  // namespace

std::string part_value_text(const Subscore& part, const std::optional<double>& value) {
  if (!value) return "\xE2\x80\x93";
  if (!is_share(part)) return quantity_text(value, part.unit);
  return number_text(std::round(1000 * *value) / 10) + " %";
}

std::string anchors_text(const Subscore& part) {
  return "full at " + part_value_text(part, part.full_at) + ", none at " + part_value_text(part, part.zero_at);
}

std::string gate_text(const Subscore& part, double below) {
  const double asked = part.zero_at + below * (part.full_at - part.zero_at);
  const std::string bound = part.full_at < part.zero_at ? " or less" : " or more";
  const std::string name = lower_words_of(part.name);
  if (!part.raw) return name + ": nothing was done that it measures";
  return name + " " + part_value_text(part, part.raw) + ", the gate asks " + part_value_text(part, asked) + bound;
}

std::string cap_text(const Grade& grade, const Cap& cap) {
  for (const Subscore& part : grade.subscores)
    if (cap.kind == CapKind::kGate && part.name == cap.subject)
      return "safety gate: " + gate_text(part, cap.below) + ": at most " + number_text(cap.at_most);
  return cap_sentence(cap);
}

}  // namespace trocar
