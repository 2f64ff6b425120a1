// The closing part of a report: what its words mean and how its numbers are made, with the numbers of the rules in
// force.
#include "trainees/desk/reports/reports.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

using printed::Block;
using Term = std::pair<std::string, std::string>;

std::vector<Term> progress_terms(const ProgressRules& r) {
  const auto n = [](int value) { return std::to_string(value); };
  std::string days;
  for (const int day : r.retention_days)
    days += (days.empty() ? "" : day == r.retention_days.back() ? " and " : ", ") + n(day);
  return {
      {"Score",
       "0 to 100 points: the weighted sum of the sub-scores, each the share of the way from no marks to full marks of "
       "its metric; capped "
       "where a "
       "safety gate is not met or the task was not finished. An attempt passes at the pass mark of its level."},
      {"Decision",
       "An instructor may decide otherwise than the score, with a reason. The decision stands beside the score, which "
       "stays as it was."},
      {"Tries, n",
       "Attempts that were begun and not ended by the device. Attempts at another input or under other rules of the "
       "exercise are never "
       "mixed."},
      {"Quartiles",
       "Median, lower and upper quartile, in proportion between two values (type 7 of Hyndman and Fan). Not drawn over "
       "fewer than three "
       "trainees."},
      {"Competence shown", "Sequential test LC-CUSUM (Biau 2008) over passes and failures: failure rates " +
                               number_text(r.cusum.adequate) + " adequate, " + number_text(r.cusum.inadequate) +
                               " inadequate; shown at " + number_text(r.cusum.shown_at) +
                               ", which takes at the least " + n(shortest_run(r.cusum)) +
                               " passes in a row. Lost again (relapsed) when the CUSUM of failures reaches " +
                               number_text(r.cusum.relapse_at) + "."},
      {"Reliability",
       "Of the mean of the newest " + n(r.reliability_window) +
           " scores: 1 less the variance of that mean over the variance between trainees. Ready asks for " +
           number_text(r.least_reliability) + " where it can be told."},
      {"Unsafe", "At least " + n(r.unsafe_attempts) + " of the newest " + n(r.unsafe_window) +
                     " graded attempts with a critical event or a safety gate not met."},
      {"Stuck, plateau", "Stuck: " + n(r.stuck_after) + " attempts without a pass. Plateau: the newest " +
                             n(r.plateau_window) + " scores rise by less than " + number_text(r.plateau_rise) +
                             " points (Theil-Sen slope) and the pass mark is not reached."},
      {"Check record", "At least " + n(r.integrity_attempts) + " of the newest " + n(r.integrity_window) +
                           " attempts void, ended by the device, late, or with force that was not rendered."},
      {"Retention", "Attempts " + days + " days after a certificate show whether the skill was kept."},
      {"Benchmark", "A number from people named beside it, with the rule that made it, their number n and the date."}};
}

std::vector<Term> attempt_terms() {
  return {{"Force",
           "Virtual newtons: the force of the simulated scene on the instrument, as its magnitude. Grip force is that "
           "between the jaws."},
          {"Tip path",
           "The instrument's tip in the frame of the task, x to the right, y away, z up; one scale for both axes of a "
           "picture."},
          {"Points",
           "A sub-score runs from 0 at its 'none' to 1 at its 'full'; lost points are 100 times its weight times what "
           "it lacks of 1."},
          {"Safety gate", "A sub-score below 0.5 at a gate caps the score under the pass mark."},
          {"Run report",
           "What the device loop measured of itself. At its limit: share of the contact in which the device could not "
           "give the asked force; "
           "above 5 % the attempt does not count towards a certificate."},
          {"Row hash, chain",
           "Each attempt's row is hashed with the hash of the row before. trocar db check finds a row that was "
           "changed, removed or moved."}};
}

}  // namespace

std::vector<Block> report_terms(TermsOf report, const ProgressRules& rules) {
  std::vector<Term> terms = progress_terms(rules);
  if (report == TermsOf::kAttempt) {
    terms.resize(2);
    for (Term& term : attempt_terms()) terms.push_back(std::move(term));
  } else if (report == TermsOf::kCohort) {
    terms.push_back({"Peak force, over force",
                     "Peak: mean over graded attempts of the largest contact force, virtual newtons. Over: times that "
                     "contact or grip went "
                     "above the hard limit, over all tries."});
  } else {
    terms.push_back({"Time trained", "On the exercises' clocks; preparation and pauses do not count."});
  }
  std::vector<Block> out = {
      printed::Heading{"Terms: how each number is made", 1},
      printed::Paragraph{"Rules of progress, version " + rules.version + ". Dates and times are UTC."}};
  printed::Table table{"", {{"Term", 1}, {"What it is", 5}}, {}};
  for (const Term& term : terms) table.rows.push_back({term.first, term.second});
  out.emplace_back(std::move(table));
  return out;
}

}  // namespace trocar::review
