#include "app/cli/sweep/sweep_table.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include <nlohmann/json.hpp>

#include "app/cli/text_table.h"
#include "scenarios/hands/population.h"

namespace trocar {
namespace {

constexpr double kWorseBy = 5;  ///< points that an expert must lose on the degraded arm where force is judged

/// Does the same hand earn less on a worse arm? An attempt without a number earned nothing.
std::vector<ValidityCheck> check_worse_arm(const SweepCell& worse, const SweepCell& drawn) {
  std::vector<ValidityCheck> checks;
  const auto earned = [](const HandOutcomes& of) {
    const GroupSummary s = summarise(of.scores);
    const int count = s.count + of.without_score;
    return count > 0 ? s.mean * s.count / count : 0;
  };
  for (const auto& [hand, outcome] : worse.outcomes) {
    ValidityCheck check;
    check.name = hand + ": drawn arm - " + worse.arm->name;
    check.value = earned(drawn.outcomes.at(hand)) - earned(outcome);
    check.bar = ">= " + cell(kWorseBy, 0);
    const bool asked = worse.scope.judges_force && hand == "expert" && worse.arm == &kSweepArms.back();
    check.met = !asked || check.value >= kWorseBy;
    if (!asked) check.not_asked = cell(check.value, 1) + " points";
    checks.push_back(check);
  }
  return checks;
}

/// "fault (overspeed)": what became of an attempt without a number.
std::string end_of(const SweepRow& row) {
  const std::string status = status_name(row.grade.status);
  if (!row.fault.empty()) return status + " (" + row.fault + ")";
  return row.grade.caps.empty() ? status : status + " (" + cap_sentence(row.grade.caps.front()) + ")";
}

void print_check(const ValidityCheck& check, std::ostream& out) {
  if (!check.not_asked.empty()) {
    out << "  n/a      " << check.name << ": " << check.not_asked << '\n';
    return;
  }
  char line[128];
  std::snprintf(line, sizeof line, "  %-8s %s: %.2f (%s)\n", check.met ? "met" : "NOT MET", check.name.c_str(),
                check.value, check.bar.c_str());
  out << line;
}

void print_cell(const SweepCell& at, std::ostream& out) {
  using Align = TextTable::Align;
  out << at.exercise << "  " << at.level << (at.arm == &kSweepArms[0] ? "" : std::string("  arm: ") + at.arm->name)
      << '\n';
  TextTable table({{"  hand"},
                   {"attempts", Align::kRight},
                   {"mean", Align::kRight},
                   {"SD", Align::kRight},
                   {"lowest", Align::kRight},
                   {"highest", Align::kRight},
                   {"passed", Align::kRight},
                   {"share", Align::kRight}});
  for (const std::string& hand : at.hands) {
    const HandOutcomes& outcome = at.outcomes.at(hand);
    const GroupSummary s = summarise(outcome.scores);
    table.add({"  " + hand, std::to_string(s.count + outcome.without_score), cell(s.mean, 1), cell(s.sd, 1),
               cell(s.lowest, 1), cell(s.highest, 1), std::to_string(outcome.passes), cell(pass_share(outcome), 2)});
  }
  table.print(out);
  for (const SweepRow& row : at.without_number) {
    out << "  no number: not passed: " << row.key.hand << ", seed " << row.key.seed << ": " << end_of(row) << '\n';
  }
  for (const ValidityCheck& check : at.checks) print_check(check, out);
}

nlohmann::ordered_json cell_json(const SweepCell& at) {
  nlohmann::ordered_json hands = nlohmann::ordered_json::array(), without = hands;
  for (const std::string& hand : at.hands) {
    const HandOutcomes& outcome = at.outcomes.at(hand);
    const GroupSummary s = summarise(outcome.scores);
    nlohmann::ordered_json caps = nlohmann::ordered_json::object();
    if (const auto found = at.caps.find(hand); found != at.caps.end()) caps = found->second;
    hands.push_back({{"hand", hand},
                     {"mean", s.mean},
                     {"sd", s.sd},
                     {"passes", outcome.passes},
                     {"pass_share", pass_share(outcome)},
                     {"without_score", outcome.without_score},
                     {"scores", outcome.scores},
                     {"caps", caps}});
  }
  for (const SweepRow& row : at.without_number) {
    without.push_back({{"hand", row.key.hand}, {"seed", row.key.seed}, {"end", end_of(row)}});
  }
  return {{"exercise", at.exercise},   {"level", at.level},
          {"arm", at.arm->name},       {"hands", hands},
          {"without_number", without}, {"checks", nlohmann::ordered_json::parse(checks_json(at.checks))}};
}

}  // namespace

std::string checks_json(const std::vector<ValidityCheck>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ValidityCheck& check : checks) {
    nlohmann::ordered_json one{{"name", check.name}, {"value", nullptr}, {"bar", nullptr}, {"met", check.met}};
    if (check.not_asked.empty()) {
      one["value"] = check.value;
      one["bar"] = check.bar;
    } else {
      one["not_asked"] = check.not_asked;
    }
    list.push_back(one);
  }
  return list.dump();
}

std::vector<SweepCell> collect_cells(const std::vector<SweepJob>& jobs) {
  std::vector<SweepCell> cells;
  for (const SweepJob& job : jobs) {
    const SweepRow& row = job.row;
    if (cells.empty() || cells.back().exercise != job.given || cells.back().level != row.key.level ||
        cells.back().arm != job.arm) {
      cells.emplace_back();
      cells.back().arm = job.arm;
      cells.back().exercise = job.given;
      cells.back().level = row.key.level;
      cells.back().scope = job.scope;
    }
    SweepCell& at = cells.back();
    const std::string hand = row.skill ? split_person(row.key.hand).first : row.key.hand;
    if (std::find(at.hands.begin(), at.hands.end(), hand) == at.hands.end()) at.hands.push_back(hand);
    HandOutcomes& outcome = at.outcomes[hand];
    if (row.grade.score) {
      outcome.scores.push_back(*row.grade.score);
    } else {
      ++outcome.without_score;
      outcome.too_fast += too_fast(row.fault) ? 1 : 0;
      at.without_number.push_back(row);
    }
    outcome.passes += row.grade.passed ? 1 : 0;
    for (const Cap& cap : row.grade.caps) ++at.caps[hand][cap_sentence(cap)];
  }
  for (SweepCell& at : cells) {
    const auto drawn = std::find_if(cells.begin(), cells.end(), [&](const SweepCell& other) {
      return other.arm == &kSweepArms[0] && other.exercise == at.exercise && other.level == at.level;
    });
    if (at.arm == &kSweepArms[0])
      at.checks = check_validity(at.outcomes, at.scope);
    else if (drawn != cells.end())
      at.checks = check_worse_arm(at, *drawn);
  }
  return cells;
}

bool all_met(const std::vector<SweepCell>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const SweepCell& at) {
    return std::all_of(at.checks.begin(), at.checks.end(), [](const ValidityCheck& check) { return check.met; });
  });
}

void print_cells(const std::vector<SweepCell>& cells, std::ostream& out) {
  for (const SweepCell& at : cells) print_cell(at, out);
}

std::string cells_json(const std::vector<SweepCell>& cells, const std::string& seeds) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SweepCell& at : cells) list.push_back(cell_json(at));
  return nlohmann::ordered_json{{"seeds", seeds}, {"met", all_met(cells)}, {"cells", list}}.dump(2) + "\n";
}

}  // namespace trocar
