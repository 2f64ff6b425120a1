#include "app/cli/attempts/scenario_test.h"

#include <algorithm>
#include <sstream>

#include "haptics/input_error.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/files/level_reader.h"
#include "scenarios/files/strict_toml.h"
#include "scenarios/scoring/metrics.h"
#include "tissue/solid/tissue_table.h"

namespace trocar {
namespace {

constexpr double kMost = 1e9;
constexpr std::size_t kMostInjections = 16;

/// A name, or a file beside the test.
std::string beside(const std::filesystem::path& test, const std::string& name) {
  return name.ends_with(".toml") ? (test.parent_path() / name).lexically_normal().string() : name;
}

RunOptions read_run(StrictTable table, const std::filesystem::path& file) {
  RunOptions run;
  run.exercise = beside(file, table.text("exercise"));
  run.hand = beside(file, table.text("hand"));
  run.level = table.text_or("level", run.level);
  run.seed = table.integer_or("seed", 0, 1000000000, 1);
  if (table.has("board")) run.board = table.integer("board", 0, 19);
  table.allow("board");
  run.organ = beside(file, table.text_or("organ", run.organ));
  std::vector<std::string> tissues;
  for (const auto& word : kTissueWords) tissues.emplace_back(word);
  run.tissue = table.choice_or("tissue", tissues, "");
  run.attempt = table.integer_or("attempt", 1, 100000, 1);
  run.contact_law = table.choice_or("contact", {"proxy", "thesis"}, run.contact_law);
  run.rate_hz = table.number_or("rate_hz", 1000, 4000, run.rate_hz);
  if (const std::string plant = table.text_or("plant", ""); !plant.empty()) run.plant = beside(file, plant);
  table.allow("inject");
  if (table.has("inject"))
    run.injections = table.texts("inject", kMostInjections, [](const std::string& text) -> std::string {
      try {
        parse_injection(text);
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    });
  table.finish();
  return run;
}

Range read_range(StrictTable& table, const std::string& key, double low, double high) {
  const auto [from, to] = table.pair(key, low, high);
  if (from > to) table.fail(key, "'" + key + "' must be [low, high]");
  return {from, to};
}

std::vector<ExpectedEvent> read_events(std::vector<StrictTable> tables) {
  std::vector<std::string> known;
  for (const EventType type : event_type::kAll) known.emplace_back(type.name);
  std::vector<ExpectedEvent> out;
  for (StrictTable& table : tables) {
    ExpectedEvent event;
    event.type = table.choice("type", known);
    event.count = read_range(table, "count", 0, kMost);
    table.allow("first_s");
    if (table.has("first_s")) event.first_s = read_range(table, "first_s", -kMost, kMost);
    table.finish();
    out.push_back(event);
  }
  return out;
}

std::vector<ExpectedValue> read_values(std::vector<StrictTable> tables, const std::vector<std::string>& known) {
  std::vector<ExpectedValue> out;
  for (StrictTable& table : tables) {
    out.push_back({table.choice("name", known), read_range(table, "between", -kMost, kMost)});
    table.finish();
  }
  return out;
}

void read_expect(StrictTable table, const Exercise& exercise, const ExerciseLevel& level, ScenarioTest& test) {
  for (const char* key : {"status", "fault", "passed", "score", "caps", "events", "metrics", "subscores"})
    table.allow(key);
  if (table.has("status")) {
    std::vector<std::string> known;
    for (const AttemptStatus status : {AttemptStatus::kCompleted, AttemptStatus::kTimeout, AttemptStatus::kAborted,
                                       AttemptStatus::kFault, AttemptStatus::kVoid})
      known.emplace_back(status_name(status));
    test.status = table.choice("status", known);
  }
  if (table.has("fault")) test.fault = table.text("fault");
  if (table.has("passed")) test.passed = table.flag_or("passed", false);
  if (table.has("score")) test.score = read_range(table, "score", 0, 100);
  if (table.has("caps")) test.caps = read_range(table, "caps", 0, 10);
  if (table.has("events")) test.events = read_events(table.tables("events"));
  std::vector<std::string> subscores;
  for (const SubscoreRule& rule : level.rubric.subscores) subscores.push_back(rule.name);
  if (table.has("metrics")) test.metrics = read_values(table.tables("metrics"), metric_names(exercise));
  if (table.has("subscores")) test.subscores = read_values(table.tables("subscores"), subscores);
  table.finish();
  if (!test.status && !test.fault && !test.passed && !test.score && !test.caps && test.events.empty() &&
      test.metrics.empty() && test.subscores.empty())
    table.fail("status", "[expect] expects nothing: such a test cannot fail");
}

std::string number_words(double value) {
  std::ostringstream out;
  out.precision(6);
  out << value;
  return out.str();
}
std::string range_words(const Range& range) {
  if (range.low == range.high) return number_words(range.low);
  return number_words(range.low) + " to " + number_words(range.high);
}

class Comparison {
 public:
  void text(const std::string& what, const std::string& value, const std::optional<std::string>& expected) {
    if (expected && value != *expected) add(what, value, *expected);
  }
  void number(const std::string& what, const std::optional<double>& value, const Range& expected) {
    if (!value || !expected.has(*value)) add(what, value ? number_words(*value) : "not defined", range_words(expected));
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  void add(const std::string& what, const std::string& value, const std::string& expected) {
    lines_.push_back(what + " is " + value + ", expected " + expected);
  }
  std::vector<std::string> lines_;
};

}  // namespace

ScenarioTest read_scenario_test(const std::filesystem::path& file, const AssetRoots& assets) {
  StrictTable document = StrictTable::parse(read_text_file(file.string()), file.string());
  ScenarioTest test;
  test.file = file;
  test.name = document.text("name");
  test.run = read_run(document.table("run"), file);
  const Exercise exercise = find_exercise(test.run.exercise, assets.exercises);
  read_expect(document.table("expect"), exercise, find_level(exercise, test.run.level), test);
  document.finish();
  return test;
}

std::vector<std::string> unmet(const ScenarioTest& test, const AttemptResult& result) {
  Comparison compared;
  const Grade& grade = result.grade;
  compared.text("status", status_name(grade.status), test.status);
  compared.text("fault", result.device.fault.empty() ? "none" : result.device.fault, test.fault);
  if (test.passed) compared.text("passed", grade.passed ? "true" : "false", *test.passed ? "true" : "false");
  if (test.score) compared.number("score", grade.score, *test.score);
  if (test.caps) compared.number("number of caps", static_cast<double>(grade.caps.size()), *test.caps);
  const auto is = [&](EventType type) { return [type](const Event& event) { return event.type == type; }; };
  const auto start = std::find_if(result.events.begin(), result.events.end(), is(event_type::kStart));
  for (const ExpectedEvent& expected : test.events) {
    const auto first = std::find_if(result.events.begin(), result.events.end(),
                                    [&](const Event& event) { return event.type == expected.type; });
    compared.number("number of " + expected.type,
                    static_cast<double>(std::count_if(result.events.begin(), result.events.end(),
                                                      [&](const Event& event) { return event.type == expected.type; })),
                    expected.count);
    if (!expected.first_s) continue;
    const bool timed = first != result.events.end() && start != result.events.end();
    compared.number("time of the first " + expected.type, timed ? std::optional(first->t_s - start->t_s) : std::nullopt,
                    *expected.first_s);
  }
  for (const ExpectedValue& expected : test.metrics) {
    const auto metric = std::find_if(grade.metrics.begin(), grade.metrics.end(),
                                     [&](const Metric& m) { return m.name == expected.name; });
    compared.number(expected.name, metric == grade.metrics.end() ? std::nullopt : metric->value, expected.between);
  }
  for (const ExpectedValue& expected : test.subscores) {
    const auto part = std::find_if(grade.subscores.begin(), grade.subscores.end(),
                                   [&](const Subscore& s) { return s.name == expected.name; });
    compared.number("sub-score " + expected.name,
                    part == grade.subscores.end() ? std::nullopt : std::optional(part->value), expected.between);
  }
  return compared.take();
}

}  // namespace trocar
