#include "trainees/desk/queries/harm.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "scenarios/scoring/event_types.h"
#include "trainees/markup/html.h"
#include "trainees/markup/score_words.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar {
namespace {

/// Ends of an attempt that stand among the events, and do no harm.
bool is_end(const std::string& type) {
  return type == event_type::kTimeout || type == event_type::kDeviceFault || type == event_type::kDeadmanOpen;
}

struct WorstGate {
  double value = 2;
  std::string words = {};
};

std::string times(int count) { return count == 1 ? "once" : std::to_string(count) + " times"; }

std::string trend_words(const Harm& harm) {
  const int now = harm.unsafe * harm.attempts_before, before = harm.unsafe_before * harm.attempts;
  return now > before ? "getting worse" : now < before ? "getting better" : "no better";
}

std::string force_words(const Harm& harm) {
  if (!harm.peak_n || *harm.peak_n <= 0) return "";
  const std::string peak = "peak force " + fixed_text(*harm.peak_n, 1) + " N";
  if (harm.limit_n <= 0) return peak;
  const std::string limit = "the limit of " + number_text(harm.limit_n) + " N";
  return harm.over_limit() > 1 ? peak + ", " + fixed_text(harm.over_limit(), 1) + " times " + limit
                               : peak + ", under " + limit;
}

}  // namespace

int Harm::critical() const {
  return std::accumulate(events.begin(), events.end(), 0,
                         [](int sum, const HarmfulEvents& e) { return sum + (e.critical ? e.count : 0); });
}

int Harm::count() const {
  return std::accumulate(events.begin(), events.end(), 0,
                         [](int sum, const HarmfulEvents& e) { return sum + e.count; });
}

void read_harm(sqlite3* connection, const std::vector<std::int64_t>& attempts, Harm& harm) {
  sql::Statement events(connection,
                        "SELECT k.type, k.severity = 'critical' FROM event_row r JOIN event_kind k ON k.id = r.kind_id"
                        " WHERE r.id BETWEEN ?1 << 20 AND ?1 << 20 | 1048575 AND k.severity IN ('major', 'critical')");
  sql::Statement gates(
      connection,
      "SELECT p.name, p.value, p.raw, p.unit, p.full_at, p.zero_at, c.below FROM score s JOIN score_cap"
      " c ON c.score_id = s.id AND c.kind = 'gate' JOIN subscore p ON p.score_id = s.id AND p.name = "
      "c.subject WHERE s.attempt_id = ? AND s.revision = 0");
  std::map<std::pair<bool, std::string>, int> counted;
  std::map<std::string, WorstGate> worst;
  for (const std::int64_t attempt : attempts) {
    events.bind(attempt);
    while (events.step())
      if (!is_end(events.text(0))) ++counted[{events.integer(1) != 0, events.text(0)}];
    events.run();
    gates.bind(attempt);
    while (gates.step()) {
      Subscore part;
      part.name = gates.text(0);
      part.value = gates.real(1);
      part.raw = gates.optional_real(2);
      part.unit = gates.text(3);
      part.full_at = gates.real(4);
      part.zero_at = gates.real(5);
      WorstGate& at = worst[part.name];
      if (part.value < at.value) at = {part.value, gate_text(part, gates.real(6))};
    }
    gates.run();
  }
  for (const auto& [kind, count] : counted) harm.events.push_back({kind.second, kind.first, count});
  std::stable_sort(harm.events.begin(), harm.events.end(), [](const HarmfulEvents& a, const HarmfulEvents& b) {
    return std::tuple(!a.critical, -a.count) < std::tuple(!b.critical, -b.count);
  });
  std::vector<WorstGate> gates_failed;
  for (const auto& [name, gate] : worst) gates_failed.push_back(gate);
  std::stable_sort(gates_failed.begin(), gates_failed.end(),
                   [](const WorstGate& a, const WorstGate& b) { return a.value < b.value; });
  for (const WorstGate& gate : gates_failed) harm.gates.push_back(gate.words);
}

bool worse(const Harm& a, const Harm& b) {
  const auto size = [](const Harm& h) {
    return std::tuple(h.critical(), std::max(1.0, h.over_limit()), h.count(), h.unsafe, h.unsafe - h.unsafe_before);
  };
  return size(a) > size(b);
}

std::string harm_sentence(const Harm& harm) {
  const auto of = [](int n, int all) { return std::to_string(n) + " of the " + std::to_string(all); };
  std::string out = std::to_string(harm.unsafe) + " of the last " + std::to_string(harm.attempts) +
                    (harm.attempts == 1 ? " attempt was unsafe" : " attempts were unsafe");
  if (harm.attempts_before > 0)
    out += " (" + of(harm.unsafe_before, harm.attempts_before) + " before: " + trend_words(harm) + ")";
  std::vector<std::string> parts;
  for (const HarmfulEvents& e : harm.events)
    if (e.critical) parts.push_back("critical: " + lower_words_of(e.type) + " " + times(e.count));
  parts.push_back(force_words(harm));
  for (const HarmfulEvents& e : harm.events)
    if (!e.critical) parts.push_back(lower_words_of(e.type) + " " + times(e.count));
  for (const std::string& gate : harm.gates) parts.push_back("at worst " + gate);
  const char* joined = ": ";
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    out += joined + part;
    joined = "; ";
  }
  return out;
}

}  // namespace trocar
