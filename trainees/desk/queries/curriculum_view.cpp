#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "haptics/input_error.h"
#include "trainees/desk/queries/desk_queries.h"
#include "trainees/desk/queries/desk_views.h"
#include "trainees/markup/html.h"
#include "trainees/progress/benchmarks.h"
#include "trainees/progress/programme.h"
#include "trainees/records/accounts.h"
#include "trainees/records/attempt_store.h"
#include "trainees/records/trainee_store.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::review {
namespace {

/// Values of the graded attempts, by person. @param who "", "hand:X", "group:X" or "trainee:X".
std::map<std::string, std::vector<double>> values_by_person(Database& database, const BenchmarkQuestion& q,
                                                            const std::string& who) {
  const auto part = [&](const std::string& kind) {
    return who.starts_with(kind) ? who.substr(kind.size()) : std::string();
  };
  sql::Statement query(database.connection(), R"sql(
SELECT t.code, CASE WHEN ?3 = 'score' THEN s.value ELSE (SELECT value FROM metric WHERE score_id = s.id AND name = ?3) END AS value
FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id JOIN score s ON s.attempt_id = a.id AND s.revision = 0
WHERE a.exercise_id = ?1 AND a.level = ?2 AND a.status IN ('completed', 'timeout') AND (?4 = '' OR a.hand = ?4)
  AND (?5 = '' OR EXISTS (SELECT 1 FROM membership g WHERE g.trainee_id = a.trainee_id AND g.group_name = ?5)) AND (?6 = '' OR t.code = ?6 COLLATE NOCASE)
  AND value IS NOT NULL ORDER BY t.code, a.id)sql");
  query.bind(q.exercise_id)
      .bind(q.level)
      .bind(q.metric)
      .bind(part("hand:"))
      .bind(part("group:"))
      .bind(part("trainee:"));
  std::map<std::string, std::vector<double>> out;
  while (query.step()) out[query.text(0)].push_back(query.real(1));
  return out;
}

/// One value a person: the mean.
std::vector<PersonValue> person_values(const std::map<std::string, std::vector<double>>& values_of) {
  std::vector<PersonValue> out;
  for (const auto& [who, values] : values_of) {
    double sum = 0;
    for (const double value : values) sum += value;
    out.push_back({who, sum / static_cast<double>(values.size())});
  }
  return out;
}

std::string who_words(const std::string& who) {
  if (who.starts_with("hand:")) return "input " + who.substr(5);
  if (who.starts_with("group:")) return "group " + who.substr(6);
  return who.starts_with("trainee:") ? who.substr(8) : "everybody";
}

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end == text.c_str() || *end != '\0' || !std::isfinite(value) ? std::nullopt : std::optional<double>(value);
}

double mean_of(const std::vector<PersonValue>& persons) {
  double sum = 0;
  for (const PersonValue& person : persons) sum += person.value;
  return persons.empty() ? 0 : sum / static_cast<double>(persons.size());
}

void compute(BenchmarkProposal& out, const std::vector<PersonValue>& persons, bool less, const std::string& now_utc) {
  out.n = static_cast<int>(persons.size());
  if (out.asked.rule == "fixed") {
    out.value = number_of(out.asked.fixed);
    out.source = "a person's decision";
    out.set_by_person = true;
    out.n = 0;
    if (!out.value) out.problem = "The fixed number is missing or cannot be read.";
    return;
  }
  const BenchmarkRule rule = out.asked.rule == "median"          ? BenchmarkRule::kMedian
                             : out.asked.rule == "best-quartile" ? BenchmarkRule::kBestQuartile
                                                                 : BenchmarkRule::kMeanLessSds;
  const auto derived = derive_benchmark(rule, persons, less, 2, who_words(out.asked.who), now_utc);
  if (!derived) {
    out.problem =
        "At least three people are needed, one value each: a script that runs a hundred times is one person. Here: " +
        std::to_string(persons.size()) + ".";
    return;
  }
  out.value = derived->limit;
  out.mean = derived->mean;
  out.deviation = derived->sd;
  out.source = derived->who;
}

/// Names that a benchmark of the exercise may be of, without the score.
std::vector<std::string> known_metrics(Desk& desk, const std::string& exercise_id) {
  if (!desk.sources.metrics.empty()) return desk.sources.metrics;
  const AttemptStore store(desk.database);
  const auto newest = store.list({"", exercise_id, 1});
  std::vector<std::string> out;
  if (newest.empty() || newest.front().status == "running") return out;
  for (const Metric& metric : store.load(newest.front().row).grade.metrics) out.push_back(metric.name);
  return out;
}

/// What makes a question senseless before anything is computed; "" for nothing.
std::string question_problem(Desk& desk, const BenchmarkQuestion& q) {
  if (q.metric != "score") {
    const std::vector<std::string> known = known_metrics(desk, q.exercise_id);
    if (std::find(known.begin(), known.end(), q.metric) == known.end()) {
      std::string list = "score";
      for (const std::string& name : known) list += ", " + name;
      return "There is no metric \"" + q.metric + "\". Known are: " + list + ".";
    }
  }
  const LawfulRange range = lawful_range(q.metric);
  for (const std::string* text : {&q.fixed, &q.zero_at}) {
    const std::optional<double> value = number_of(*text);
    const bool asked = text == &q.fixed ? q.rule == "fixed" : q.metric != "score";
    if (asked && value && !lawful(range, *value))
      return "The number " + number_text(*value) + " is none that \"" + q.metric +
             "\" can have: " + range_words(range) + ".";
  }
  return "";
}

std::optional<double> reliability_of(const std::map<std::string, std::vector<double>>& values_of) {
  std::vector<std::vector<double>> all;
  for (const auto& [who, values] : values_of) all.push_back(values);
  return reliability_of_means(all);
}

void add_groups(CurriculumView& view, const CurriculumStore& store) {
  for (const std::string& group : store.groups()) view.groups.push_back({group, store.members(group)});
}

DifficultyView difficulties(Database& database, const ProgressRules& rules, const std::vector<Choice>& exercises) {
  const RaschReport rasch = rasch_report(database, rules);
  DifficultyView out;
  out.attempts = rasch.attempts;
  out.missing = rasch.missing;
  out.rules_version = rules.version;
  std::map<std::string, std::string> titles(exercises.begin(), exercises.end());
  for (const RaschItem& item : rasch.items) {
    const std::string& title = titles[item.exercise_id];
    out.lines.push_back({title.empty() ? item.exercise_id : title, item.level, item.hand, item.estimate.logit,
                         item.estimate.standard_error, item.estimate.n});
  }
  if (out.missing.empty() && out.lines.empty())
    out.missing = "No difficulty is known well enough yet: standard errors are above what the rules allow.";
  return out;
}

bool passes(const CohortLine& line) {
  return !line.certified_utc.empty() || std::any_of(line.judgements.begin(), line.judgements.end(),
                                                    [](const Judgement& j) { return j.flag == Flag::kReady; });
}

void changes_first(std::vector<PassPreview>& out) {
  std::stable_sort(out.begin(), out.end(), [](const PassPreview& a, const PassPreview& b) {
    const auto rank = [](const PassPreview& p) { return p.passes_now != p.would_pass ? 0 : p.would_pass ? 1 : 2; };
    return rank(a) < rank(b);
  });
}

}  // namespace

std::vector<PassPreview> preview_rules(Desk& desk, const ProgressRules& rules, const std::string& now_utc) {
  const std::vector<CohortLine> now = cohort_lines(desk.database, rules_in_force(desk.database), {}, now_utc),
                                then = cohort_lines(desk.database, rules, {}, now_utc);
  std::map<std::pair<std::string, CurveKey>, bool> before;
  for (const CohortLine& line : now) before[{line.trainee, line.key}] = passes(line);
  const std::vector<Choice> exercises = exercise_choices(desk.database);
  std::map<std::string, std::string> titles(exercises.begin(), exercises.end());
  std::vector<PassPreview> out;
  for (const CohortLine& line : then)
    out.push_back({line.trainee, titles[line.key.exercise_id], line.key.level,
                   line.judgements.empty() ? "" : line.judgements.front().evidence, before[{line.trainee, line.key}],
                   passes(line)});
  changes_first(out);
  return out;
}

BenchmarkProposal propose(Desk& desk, const BenchmarkQuestion& question, const std::string& now_utc) {
  BenchmarkProposal out;
  out.asked = question;
  out.rules_version = rules_in_force(desk.database).version;
  out.problem = question_problem(desk, question);
  if (!out.problem.empty()) return out;
  const auto values_of = values_by_person(desk.database, question, question.who);
  const std::vector<PersonValue> chosen = person_values(values_of),
                                 all = person_values(values_by_person(desk.database, question, ""));
  const std::optional<double> zero = number_of(question.zero_at);
  if (question.metric != "score" && !zero) {
    out.problem = "A metric needs the value at which no marks are left: it says which way is better.";
    return out;
  }
  const bool less = question.metric != "score" && zero && *zero > (chosen.empty() ? mean_of(all) : mean_of(chosen));
  compute(out, chosen, less, now_utc);
  if (!out.value) return out;
  const LawfulRange range = lawful_range(question.metric);
  if (!lawful(range, *out.value)) {
    out.problem = "The number " + number_text(*out.value) + " is none that \"" + question.metric +
                  "\" can have: " + range_words(range) + ".";
    out.value.reset();
    return out;
  }
  if (!out.set_by_person) out.reliability = reliability_of(values_of);
  const auto held = CurriculumStore(desk.database).benchmarks(question.exercise_id, question.level);
  const auto old =
      std::find_if(held.begin(), held.end(), [&](const Benchmark& b) { return b.metric == question.metric; });
  const auto reaches = [less](double value, double limit) { return less ? value <= limit : value >= limit; };
  for (const PersonValue& person : all)
    out.preview.push_back({person.who, exercise_title(desk.database, question.exercise_id), question.level,
                           "mean " + number_text(person.value),
                           old == held.end() ? std::nullopt : std::optional(reaches(person.value, old->full_at)),
                           reaches(person.value, *out.value)});
  changes_first(out.preview);
  return out;
}

std::string own_version_of(const Curriculum& curriculum) {
  try {
    return read_progress_rules(curriculum.toml, curriculum.name).version;
  } catch (const InputError&) {
    return "";  // no rules of progress: another kind of text
  }
}

void refuse_taken_version(Desk& desk, const std::string& text, const ProgressRules& rules) {
  const auto taken = [&](const std::string& by) {
    throw InputError("version \"" + rules.version + "\" is that of another text, " + by +
                     "; every decision names its version, so give this text one of its own");
  };
  for (const Curriculum& kept : CurriculumStore(desk.database).list(true))
    if (kept.toml != text && own_version_of(kept) == rules.version)
      taken("\"" + kept.name + "\", saved on " + kept.utc.substr(0, 10) + " as no. " + std::to_string(kept.version));
  const std::string& shipped = desk.sources.shipped_rules;
  if (!shipped.empty() && shipped != text && read_progress_rules(shipped, "shipped rules").version == rules.version)
    taken("the one that came with the program");
}

CurriculumView curriculum_view(Desk& desk, const Request& request) {
  const CurriculumStore store(desk.database);
  CurriculumView view;
  view.versions = store.list();
  std::erase_if(view.versions,
                [](const Curriculum& one) { return is_programme(one.toml); });  // they have their own pages
  view.name = argument(request.query, "name", kRulesName);
  const std::string version = argument(request.query, "version");
  view.text = desk.sources.shipped_rules;
  bool found = version.empty() && view.name == kRulesName;
  for (auto it = view.versions.rbegin(); it != view.versions.rend(); ++it) {
    view.own_version[it->uuid] = own_version_of(*it);
    if (it->name != view.name || (!version.empty() && std::to_string(it->version) != version)) continue;
    view.text = it->toml;
    found = true;
  }
  if (!found)
    throw InputError("no rules of the name \"" + view.name + "\"" +
                     (version.empty() ? "" : " were saved as no. " + version) + " are kept here");
  view.seen_name = view.name;
  if (const auto newest = store.newest(view.name)) view.seen = newest->uuid;
  const ProgressRules rules = rules_in_force(desk.database);
  view.rules_version = rules.version;
  view.rules_unread = rules.unread;
  for (const Account& account : AccountStore(desk.database).list()) view.authors[account.uuid] = account.name;
  view.benchmarks = store.benchmarks();
  add_groups(view, store);
  for (const Trainee& trainee : TraineeStore(desk.database).list())
    if (!trainee.code.starts_with("erased-")) view.trainees.push_back(trainee.code);
  view.levels = distinct_attempt_values(desk.database, "level");
  view.hands = distinct_attempt_values(desk.database, "hand");
  view.exercises = exercise_choices(desk.database);
  view.difficulties = difficulties(desk.database, rules, view.exercises);
  return view;
}

}  // namespace trocar::review
