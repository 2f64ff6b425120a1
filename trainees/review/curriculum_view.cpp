#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "haptics/input_error.h"
#include "trainees/markup/html.h"
#include "trainees/progress/benchmarks.h"
#include "trainees/review/desk_queries.h"
#include "trainees/review/desk_views.h"
#include "trainees/sqlite_handle.h"
#include "trainees/trainee_store.h"

namespace trocar::review {
namespace {

/// One value a person: the mean of the graded attempts. @param who "", "hand:X", "group:X" or "trainee:X".
std::vector<PersonValue> person_values(Database& database, const BenchmarkQuestion& q, const std::string& who) {
  const auto part = [&](const std::string& kind) { return who.starts_with(kind) ? who.substr(kind.size()) : std::string(); };
  sql::Statement query(database.connection(), R"sql(
SELECT t.code, avg(CASE WHEN ?3 = 'score' THEN s.value ELSE m.value END) AS mean
FROM attempt a JOIN known_trainee t ON t.id = a.trainee_id JOIN score s ON s.attempt_id = a.id AND s.revision = 0
LEFT JOIN metric m ON m.score_id = s.id AND m.name = ?3
WHERE a.exercise_id = ?1 AND a.level = ?2 AND a.status IN ('completed', 'timeout') AND (?4 = '' OR a.hand = ?4)
  AND (?5 = '' OR EXISTS (SELECT 1 FROM membership g WHERE g.trainee_id = a.trainee_id AND g.group_name = ?5)) AND (?6 = '' OR t.code = ?6 COLLATE NOCASE)
GROUP BY t.id HAVING mean IS NOT NULL ORDER BY t.code)sql");
  query.bind(q.exercise_id).bind(q.level).bind(q.metric).bind(part("hand:")).bind(part("group:")).bind(part("trainee:"));
  std::vector<PersonValue> out;
  while (query.step()) out.push_back({query.text(0), query.real(1)});
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
    out.n = 0;
    if (!out.value) out.problem = "The fixed number is missing or cannot be read.";
    return;
  }
  const BenchmarkRule rule = out.asked.rule == "median"          ? BenchmarkRule::kMedian
                             : out.asked.rule == "best-quartile" ? BenchmarkRule::kBestQuartile
                                                                 : BenchmarkRule::kMeanLessSds;
  const auto derived = derive_benchmark(rule, persons, less, 2, who_words(out.asked.who), now_utc);
  if (!derived) {
    out.problem = "At least three people are needed, one value each: a script that runs a hundred times is one person. Here: " +
                  std::to_string(persons.size()) + ".";
    return;
  }
  out.value = derived->limit;
  out.mean = derived->mean;
  out.deviation = derived->sd;
  out.source = derived->who;
}

void add_groups(CurriculumView& view, const CurriculumStore& store) {
  for (const std::string& group : store.groups()) view.groups.push_back({group, store.members(group)});
}

bool passes(const CohortLine& line) {
  return !line.certified_utc.empty() ||
         std::any_of(line.judgements.begin(), line.judgements.end(), [](const Judgement& j) { return j.flag == Flag::kReady; });
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
                   line.judgements.empty() ? "" : line.judgements.front().evidence, before[{line.trainee, line.key}], passes(line)});
  changes_first(out);
  return out;
}

BenchmarkProposal propose(Desk& desk, const BenchmarkQuestion& question, const std::string& now_utc) {
  BenchmarkProposal out;
  out.asked = question;
  const std::vector<PersonValue> chosen = person_values(desk.database, question, question.who),
                                 all = person_values(desk.database, question, "");
  const std::optional<double> zero = number_of(question.zero_at);
  if (question.metric != "score" && !zero) {
    out.problem = "A metric needs the value at which no marks are left: it says which way is better.";
    return out;
  }
  const bool less = question.metric != "score" && zero && *zero > (chosen.empty() ? mean_of(all) : mean_of(chosen));
  compute(out, chosen, less, now_utc);
  if (!out.value) return out;
  const auto held = CurriculumStore(desk.database).benchmarks(question.exercise_id, question.level);
  const auto old = std::find_if(held.begin(), held.end(), [&](const Benchmark& b) { return b.metric == question.metric; });
  const auto reaches = [less](double value, double limit) { return less ? value <= limit : value >= limit; };
  for (const PersonValue& person : all)
    out.preview.push_back({person.who, exercise_title(desk.database, question.exercise_id), question.level,
                           "mean " + number_text(person.value), old != held.end() && reaches(person.value, old->full_at),
                           reaches(person.value, *out.value)});
  changes_first(out.preview);
  return out;
}

CurriculumView curriculum_view(Desk& desk, const Request& request) {
  const CurriculumStore store(desk.database);
  CurriculumView view;
  view.versions = store.list();
  view.name = argument(request.query, "name", kRulesName);
  const std::string version = argument(request.query, "version");
  view.text = desk.sources.shipped_rules;
  for (auto it = view.versions.rbegin(); it != view.versions.rend(); ++it)
    if (it->name == view.name && (version.empty() || std::to_string(it->version) == version)) view.text = it->toml;
  view.benchmarks = store.benchmarks();
  add_groups(view, store);
  for (const Trainee& trainee : TraineeStore(desk.database).list())
    if (!trainee.code.starts_with("erased-")) view.trainees.push_back(trainee.code);
  view.levels = distinct_attempt_values(desk.database, "level");
  view.hands = distinct_attempt_values(desk.database, "hand");
  view.exercises = exercise_choices(desk.database);
  return view;
}

}  // namespace trocar::review
