// A certificate's page: what was shown, by which numbers, and what it does not say.
#include <algorithm>
#include <set>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/reports/report_words.h"
#include "trainees/markup/html.h"
#include "trainees/progress/cusum.h"

namespace trocar::review {
namespace {

/// The judgement's sentence without its last clause, which is about the decision that has been made meanwhile.
std::string shown_words(const std::string& evidence) {
  std::string out = evidence.substr(0, evidence.find("; a person decides"));
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out.empty() || out.back() == '.' ? out : out + ".";
}

std::string list_of(const std::set<std::string>& values, const std::string& none) {
  std::string out;
  for (const std::string& value : values) out += (out.empty() ? "" : ", ") + value;
  return out.empty() ? none : out;
}

struct Totals {
  std::set<std::string> devices, inputs;
  int passed = 0, passed_now = 0;
  bool simulated = true, without_device = true;  ///< each of them
};

Totals totals_of(const CertificateView& view) {
  Totals out;
  for (const CertifiedAttempt& a : view.attempts) {
    const bool simulated = a.backend.find("sim") != std::string::npos;
    out.simulated = out.simulated && simulated;
    out.without_device = out.without_device && without_device(a.backend);
    out.devices.insert(simulated                   ? "simulated plant"
                       : without_device(a.backend) ? "no device"
                       : a.backend.empty()         ? "not recorded"
                                                   : a.backend);
    out.inputs.insert(a.hand);
    out.passed += a.passed ? 1 : 0;
    out.passed_now += a.passed_now ? 1 : 0;
  }
  return out;
}

std::string rule_words(const CertificateView& view, const ReportSetting& setting) {
  if (setting.rules.version != view.certificate.rule_version) return "";
  const CusumRule& r = setting.rules.cusum;
  return " Test: LC-CUSUM, failure rates " + number_text(r.adequate) + " adequate and " + number_text(r.inadequate) +
         " inadequate, shown at " + number_text(r.shown_at) + " (at the least " + std::to_string(shortest_run(r)) +
         " passes in a row).";
}

std::string passed_words(const Totals& totals, const CertificateView& view) {
  const std::string then = std::to_string(totals.passed) + " of " + std::to_string(view.attempts.size());
  if (totals.passed == totals.passed_now) return then;
  return then + " when it was given, " + std::to_string(totals.passed_now) + " as they count now";
}

std::string result_of(const CertifiedAttempt& a) {
  const auto words = [](bool passed) { return std::string(passed ? "passed" : "not passed"); };
  if (!a.decided_since.empty() && a.passed_now != a.passed)
    return "since: " + words(a.passed_now) + ", by " + a.decided_since;
  return (a.decided_by.empty() ? result_words(a.score.has_value(), a.passed)
                               : words(a.passed) + ", by " + a.decided_by) +
         (a.soft_real_time ? ", soft real time" : "");
}

std::vector<std::string> not_attested(const Totals& totals) {
  return {
      "Skill with patients, in an operating theatre, or with other instruments; it is no medical qualification and no "
      "licence.",
      totals.without_device ? "Work on a device: the attempts were made without one and nothing was felt; forces are "
                              "virtual newtons of a simulation."
      : totals.simulated
          ? "Work on a device: the attempts were made on a simulated plant; forces are virtual newtons of a simulation."
          : "Forces as in tissue: they are virtual newtons of a simulation.",
      "That the skill is kept: it fades, and attempts for keeping come due after this date."};
}

}  // namespace

printed::CertificateSheet certificate_sheet(const CertificateView& view, const ReportSetting& setting) {
  const Certificate& c = view.certificate;
  const Totals totals = totals_of(view);
  const std::string none = "not recorded";
  printed::CertificateSheet out;
  out.holder = view.name.empty() ? c.trainee : view.name;
  out.code = c.trainee;
  out.skill = view.exercise + ", level " + c.level;
  out.statement = shown_words(view.evidence) + rule_words(view, setting);
  const std::string period =
      view.attempts.empty() ? none : period_words(view.attempts.front().utc, view.attempts.back().utc);
  out.facts = {
      {"Attempts it rests on", view.n > 0 ? "n = " + std::to_string(view.n) : none},
      {"Passed", passed_words(totals, view)},
      {"Reliability of the mean score", view.reliability ? reliability_words(*view.reliability) : "could not be told"},
      {"Period of the attempts", period},
      {"Rules of progress", "version " + c.rule_version},
      {"Device, input", list_of(totals.devices, none) + "; " + list_of(totals.inputs, none)}};
  out.columns = {{"No.", 0.6, true}, {"When (UTC)", 2.2},  {"Score", 0.9, true},
                 {"Result", 2.6},    {"Chain", 0.9, true}, {"Row hash (sha256)", 4.6, false, true}};
  for (std::size_t i = 0; i < view.attempts.size(); ++i) {
    const CertifiedAttempt& a = view.attempts[i];
    out.evidence.push_back({std::to_string(i + 1), moment_text(a.utc), score_text(a.score), result_of(a),
                            a.chain_position > 0 ? std::to_string(a.chain_position) : "", a.row_hash.substr(0, 32)});
  }
  const auto found = static_cast<int>(view.attempts.size());
  out.evidence_words = plural(found, "attempt", "attempts") +
                       " with the first 32 digits of the hash of its row in the record" +
                       (view.n > 0 && found != view.n ? "; the judgement counted " + std::to_string(view.n) : "") +
                       (view.witness.empty() ? "" : "; this certificate is " + view.witness);
  out.not_attested = not_attested(totals);
  out.certified_by = c.printed.empty() ? none : c.printed;
  out.date = moment_text(c.utc);
  out.uuid = c.uuid;
  if (!c.revoked_utc.empty()) out.withdrawn = "on " + printed::day_text(c.revoked_utc) + ": " + c.revoked_reason;
  out.newest_utc = std::max(c.utc, c.revoked_utc);
  out.in_question = dated(view.in_question);
  out.demo = setting.demo;
  return out;
}

}  // namespace trocar::review
