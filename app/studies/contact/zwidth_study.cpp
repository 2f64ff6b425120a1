#include "app/studies/contact/zwidth_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <sstream>

#include "app/studies/contact/passivity_grid.h"

namespace trocar {
namespace {

constexpr std::array kLadder{50.0,  75.0,   110.0,  160.0,  240.0,  350.0, 520.0,
                             770.0, 1130.0, 1660.0, 2450.0, 3600.0, 5300.0};  // N/m
constexpr std::array kDampings{0.0, 0.5, 1.0, 2.0, 4.0};                      // N s/m
constexpr int kContacts = 20, kQuickContacts = 3;
constexpr double kAfterTouch = 1.0;  // s
constexpr double kQuicklySettled = 0.1;

using Rigs = std::vector<std::unique_ptr<WallRig>>;

Rigs prepare(const StudyRequest& request, int contacts, double rate_hz, bool edge_times = false) {
  const PressDraw draw{{150}, {0}, 0.1, 0.9, rate_hz, request.nominal};
  std::vector<DrawnPress> presses = drawn_presses(request.seed, static_cast<std::size_t>(contacts), draw);
  for (DrawnPress& press : presses) press.wall.device.edge_times = edge_times;
  Rigs rigs(presses.size());
  on_all_processors(presses.size(), [&](std::size_t i) { rigs[i] = std::make_unique<WallRig>(presses[i].wall); });
  return rigs;
}

/// One climb of the ladder.
struct Climb {
  double widest = 0;                     ///< N/m, last rung at which 19 of 20 contacts were stable
  double displayed = 0;                  ///< N/m there: force over depth at rest, mean over the contacts
  double quick = 0;                      ///< N/m, last rung up to which half settled within kQuicklySettled
  double passive = 0;                    ///< N/m, last rung up to which 19 of 20 gave less than 1 mJ
  double k_max = 0;                      ///< N/m, least of the limits that the loop worked out
  std::size_t stable = 0, contacts = 0;  ///< over all rungs that were tried
};

/// @param whole go on to the top of the ladder, whatever falls on the way.
Climb climb(const Rigs& rigs, PassivityLaw law, double damping, bool whole = false) {
  Climb found;
  found.k_max = std::numeric_limits<double>::infinity();
  bool stable = true, quick = true, passive = true;
  for (const double stiffness : kLadder) {
    std::vector<WallOutcome> outcome(rigs.size());
    on_all_processors(rigs.size(), [&](std::size_t i) {
      outcome[i] = rigs[i]->press({law, false, stiffness, damping}, kAfterTouch);
      outcome[i].trace = {};
    });
    double displayed = 0;
    std::size_t stable_ones = 0, quick_ones = 0, passive_ones = 0;
    for (const WallOutcome& o : outcome) {
      stable_ones += o.stable();
      quick_ones += !o.faulted && o.settled_s <= kQuicklySettled;
      passive_ones += o.least_net_j >= -1e-3;
      displayed += o.shown_stiffness / static_cast<double>(outcome.size());
      if (o.contacts > 0) found.k_max = std::min(found.k_max, o.k_max);
    }
    const std::size_t enough = outcome.size() - outcome.size() / 20;  // 19 of 20
    stable = stable && stable_ones >= enough;
    passive = passive && passive_ones >= enough;
    quick = quick && 2 * quick_ones >= outcome.size();
    if (quick) found.quick = stiffness;
    if (passive) found.passive = stiffness;
    found.stable += stable_ones, found.contacts += outcome.size();
    if (stable) found.widest = stiffness, found.displayed = displayed;
    if (!stable && !whole) break;
    if (whole) found.displayed = displayed;
  }
  return found;
}

std::string row(double rate_hz, double damping, const char* law, const Climb& c) {
  std::ostringstream out;
  out << std::setprecision(6) << rate_hz << ',' << damping << ',' << law << ',' << c.widest << ',' << c.displayed << ','
      << c.quick << ',' << c.passive << ',' << c.k_max << '\n';
  return out.str();
}

StudyCase width(const std::string& name, double value, std::optional<double> thesis, const std::string& more) {
  return {name,
          "N/m",
          value,
          thesis,
          "reported",
          true,
          "Last rung of the ladder 50 to 5300 N/m at which 19 of 20 drawn contacts are stable" + more};
}

void boundary(StudyResult& study, const Rigs& rigs, std::string& table) {
  StudyCurves curves{"zwidth",
                     "Stiffest wall by its damping, 19 of 20 contacts stable, 1 kHz",
                     "damping B of the wall, N s/m",
                     "stiffness K, N/m",
                     {kDampings.begin(), kDampings.end()},
                     {{"law off, K", {}}, {"budgeted, K", {}}, {"budgeted, displayed", {}}}};
  for (const double damping : kDampings) {
    const Climb off = climb(rigs, PassivityLaw::kOff, damping), on = climb(rigs, PassivityLaw::kBudgeted, damping);
    curves.series[0].y.push_back(off.widest);
    curves.series[1].y.push_back(on.widest);
    curves.series[2].y.push_back(on.displayed);
    table += row(1000, damping, "off", off) + row(1000, damping, "budgeted", on);
    if (damping > 0) continue;
    study.cases.push_back(
        width("widest without damping, law off", off.widest, 20, " (the thesis used 20 N/m without control)."));
    study.cases.push_back(width("widest without damping, default law", on.widest, 150,
                                " (the thesis' experiments with control: 150 N/m)."));
    study.cases.push_back(width("displayed there", on.displayed, std::nullopt,
                                "; here: rendered force over depth at rest, mean over the contacts (beyond the motors' "
                                "limit a wall feels softer)."));
    study.cases.push_back(width("settles within 0.1 s, default law", on.quick, std::nullopt,
                                "; here: half of them settled within 0.1 s of touch."));
    study.cases.push_back(width("gives less than 1 mJ, law off", off.passive, std::nullopt,
                                "; here: 19 of 20 fed the hand less than 1 mJ, friction of the arm taken off."));
    study.cases.push_back(width("gives less than 1 mJ, default law", on.passive, std::nullopt,
                                "; here: 19 of 20 fed the hand less than 1 mJ, friction of the arm taken off."));
    study.cases.push_back({"K_max of the loop", "N/m", on.k_max, std::nullopt, "reported", true,
                           "Least of min(2 b/T, b/(T/2+Td), 2 fc/Delta) over all contacts; b and fc the least that any "
                           "motion along the force meets."});
  }
  study.curves.push_back(curves);
}

/// What a board would bring that tells when each counter last moved (DaqSample::edge_age_us).
void edge_times(StudyResult& study, const StudyRequest& request, int contacts, std::string& table) {
  const Rigs rigs = prepare(request, contacts, 1000, true);
  const Climb off = climb(rigs, PassivityLaw::kOff, 0), on = climb(rigs, PassivityLaw::kBudgeted, 0, true);
  table += row(1000, 0, "off + edge times", off) + row(1000, 0, "budgeted + edge times", on);
  study.cases.push_back(width("widest without damping, law off, edge times", off.widest, std::nullopt, "."));
  study.cases.push_back(width("gives less than 1 mJ, law off, edge times", off.passive, std::nullopt,
                              "; here: 19 of 20 fed the hand less than 1 mJ, friction of the arm taken off."));
  study.cases.push_back(width("widest without damping, default law, edge times", on.widest, std::nullopt, "."));
  study.cases.push_back({"stable on the whole ladder, default law, edge times", "%",
                         100.0 * static_cast<double>(on.stable) / static_cast<double>(on.contacts), std::nullopt,
                         "reported", true, "Share of all contacts, 20 on each rung from 50 to 5300 N/m."});
}

void rates(StudyResult& study, const StudyRequest& request, int contacts, std::string& table) {
  for (const double rate_hz : {1000.0, 2000.0, 4000.0}) {
    const Rigs rigs = prepare(request, contacts, rate_hz);
    const Climb off = climb(rigs, PassivityLaw::kOff, 0), on = climb(rigs, PassivityLaw::kBudgeted, 0, true);
    if (rate_hz > 1000) table += row(rate_hz, 0, "off", off) + row(rate_hz, 0, "budgeted", on);
    const std::string at = " at " + std::to_string(static_cast<int>(rate_hz / 1000)) + " kHz";
    study.cases.push_back(width("widest without damping, law off" + at, off.widest, std::nullopt, "."));
    study.cases.push_back({"stable on the whole ladder, default law" + at, "%",
                           100.0 * static_cast<double>(on.stable) / static_cast<double>(on.contacts), std::nullopt,
                           "reported", true, "Share of all contacts, 20 on each rung from 50 to 5300 N/m."});
    study.cases.push_back({"displayed on the top rung, default law" + at, "N/m", on.displayed, std::nullopt, "reported",
                           true, "Rendered force over depth at rest on the wall of 5300 N/m, mean over the contacts."});
    study.cases.push_back(width("settles within 0.1 s, default law" + at, on.quick, std::nullopt,
                                "; here: half of them settled within 0.1 s of touch."));
  }
}

}  // namespace

StudyResult zwidth_study(const StudyRequest& request) {
  StudyResult study{"zwidth", drawn_plant_words(request.seed, request.nominal), {}, {}};
  const int contacts = request.quick ? kQuickContacts : kContacts;
  std::string table =
      "rate_Hz,damping_N_s_m,law,widest_N_m,displayed_N_m,settles_in_0.1s_N_m,gives_under_1mJ_N_m,least_k_max_N_m\n";
  boundary(study, prepare(request, contacts, 1000), table);
  if (!request.quick) {
    rates(study, request, contacts, table);
    edge_times(study, request, contacts, table);
  }
  study.files.push_back({"zwidth_table.csv", table});
  return study;
}

}  // namespace trocar
