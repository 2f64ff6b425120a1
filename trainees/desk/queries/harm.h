// How bad the unsafe attempts of one curve are: what the list of people at risk is ordered by, and the sentence for it.
//
// Over the attempts that the rule of safety looks at (trainees/progress/judgement.h), and those before for the trend.
// Thread: the Database's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct sqlite3;

namespace trocar {

struct HarmfulEvents {
  std::string type = {};  ///< as the record has it
  bool critical = false;
  int count = 0;
};

struct Harm {
  int attempts = 0, unsafe = 0;                ///< of the rule's window
  int attempts_before = 0, unsafe_before = 0;  ///< of the same number before it
  std::optional<double> peak_n = {};           ///< largest contact force of the window
  double limit_n = 0;                          ///< hard limit of that exercise and level; 0 while it is not known
  std::vector<HarmfulEvents> events = {};  ///< major and critical ones of the window, critical first, then by number
  std::vector<std::string> gates = {};     ///< gate_text() of each gate that failed, at its worst in the window
  int critical() const;
  int count() const;  ///< of all events
  /// Peak force over the limit; 0 where either is not known.
  double over_limit() const { return peak_n && limit_n > 0 ? *peak_n / limit_n : 0; }
};

/// Fills events and gates. @param attempts rows of the window.
void read_harm(sqlite3* connection, const std::vector<std::int64_t>& attempts, Harm& harm);

/// Worse first: critical events, then how far over the limit (under it, or where none is known, nothing), then the
/// number of events, then unsafe attempts, then how many more they are than before.
bool worse(const Harm& a, const Harm& b);

/// "5 of the last 5 attempts were unsafe (4 of the 4 before: no better): peak force 3.0 N, 2.0 times the limit of 1.5
/// N; excess force 34 times; at worst force in band 31 %, the gate asks 65 % or more".
std::string harm_sentence(const Harm& harm);

}  // namespace trocar
