// A cap: what held a score down, or why there is none. The one place that puts it into words.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace trocar {

enum class CapKind : std::uint8_t {
  kGate,        ///< a safety gate was not met
  kCritical,    ///< an event of critical severity
  kUnfinished,  ///< time ran out, or an object was lost
  kVoid         ///< the record cannot be graded
};

inline constexpr std::array kCapKinds{CapKind::kGate, CapKind::kCritical, CapKind::kUnfinished, CapKind::kVoid};

/// As the database names it.
constexpr const char* cap_kind_name(CapKind kind) {
  switch (kind) {
    case CapKind::kGate:
      return "gate";
    case CapKind::kCritical:
      return "critical";
    case CapKind::kUnfinished:
      return "unfinished";
    case CapKind::kVoid:
      return "void";
  }
  return "unknown";
}

/// Fields that a kind does not have are empty or 0.
struct Cap {
  CapKind kind = CapKind::kCritical;
  std::string subject = {};  ///< kGate: the sub-score; kVoid: what is wrong with the record
  double below = 0;          ///< kGate: share of the sub-score that would have met it, 0..1
  int done = 0, total = 0;   ///< kUnfinished: objects
  double at_most = 0;        ///< the score, 0..100; not of kVoid

  bool operator==(const Cap&) const = default;
};

/// "safety: force in band below 0.5: at most 59", "critical event: at most 49", "not finished: 7 of 12: at most 28.6",
/// "void: no samples".
inline std::string cap_sentence(const Cap& cap) {
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return std::string(text);
  };
  const std::string limit = ": at most " + number(cap.at_most);
  switch (cap.kind) {
    case CapKind::kGate:
      return "safety: " + cap.subject + " below " + number(cap.below) + limit;
    case CapKind::kCritical:
      return "critical event" + limit;
    case CapKind::kUnfinished:
      return "not finished: " + std::to_string(cap.done) + " of " + std::to_string(cap.total) + limit;
    case CapKind::kVoid:
      return "void: " + cap.subject;
  }
  return "";
}

inline std::vector<std::string> cap_sentences(const std::vector<Cap>& caps) {
  std::vector<std::string> out;
  for (const Cap& cap : caps) out.push_back(cap_sentence(cap));
  return out;
}

}  // namespace trocar
