// What the desk's pages show, as plain values: a page is a function of one of these, so that every page is tested without a database.
//
// Scores 0..100, forces in virtual newtons, times of an attempt in seconds from its beginning, dates ISO 8601 UTC. Thread: any.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/curricula.h"
#include "trainees/markup/plots.h"
#include "trainees/opinions.h"
#include "trainees/progress/judgement.h"
#include "trainees/review/film_state.h"

namespace trocar::review {

/// What a choice sends and what it is called.
using Choice = std::pair<std::string, std::string>;

/// One trainee at one exercise, level and input.
struct CohortEntry {
  std::string code = {}, name = {}, exercise_id = {}, exercise = {}, level = {}, hand = {};
  int tries = 0;
  std::optional<double> best = {}, last = {};
  std::vector<double> scores = {};  ///< newest few, oldest first
  double pass_at = 75;
  std::optional<double> peak_force_n = {};  ///< mean of the peaks of the graded attempts
  int over_force = 0;                       ///< times over the hard limit, over all tries
  std::vector<Judgement> judgements = {};   ///< gravest first
  std::string last_utc = {};
  Flag state() const { return judgements.empty() ? Flag::kLearning : judgements.front().flag; }
};

/// What is asked of the cohort. sort: a column's name, "-" before it for falling; "" for the gravest first.
struct CohortQuestion {
  std::string group = {}, exercise_id = {}, level = {}, state = {}, sort = {};
  int page = 1;
};

struct CohortView {
  CohortQuestion asked = {};
  std::vector<std::string> groups = {}, levels = {};
  std::vector<Choice> exercises = {};
  std::vector<CohortEntry> lines = {};  ///< of group, exercise and level; state and order are the page's work
  int trainees = 0, attempts = 0;
  std::string rules_version = {};
};

struct CurvePoint {
  std::string uuid = {}, utc = {}, status = {};
  std::optional<double> score = {};
  bool passed = false;
};

/// Quartiles of the cohort at the n-th attempt of each.
struct CohortBand {
  int attempt = 0, n = 0;
  Quartiles quartiles = {};
};

struct CurveView {
  CurveKey key = {};
  std::string title = {};
  std::vector<CurvePoint> points = {};  ///< oldest first
  double pass_at = 75;
  std::optional<double> best = {}, last = {};
  int graded = 0, passed = 0, in_a_row = 0;
  double trained_s = 0;
  std::optional<Benchmark> benchmark = {};  ///< of the metric "score"
  std::vector<CohortBand> cohort = {};
  std::vector<CusumPoint> cusum = {};
  CusumRule rule = {};
  std::vector<Judgement> judgements = {};
  std::optional<double> reliability = {};
};

struct DueDate {
  std::string exercise = {}, level = {}, utc = {}, why = {};
  bool over = false;
};

struct TraineeView {
  std::string code = {}, name = {};
  std::vector<std::string> groups = {};
  std::vector<CurveView> curves = {};
  std::size_t chosen = 0;                                            ///< curve that is drawn
  std::vector<std::pair<std::string, double>> minutes_by_week = {};  ///< Monday's date, minutes; oldest first, no week left out
  std::vector<Note> notes = {};                                      ///< newest first
  std::vector<Certificate> certificates = {};
  std::vector<DueDate> due = {};
  std::string rules_version = {};
};

/// Another attempt that this one may be laid over.
struct Rival {
  std::string words = {}, uuid = {};
  std::optional<double> score = {};
};

struct AttemptView {
  AttemptResult result = {};
  std::string exercise = {}, program = {}, finished_utc = {}, row_hash = {};
  std::int64_t chain_position = 0;
  double pass_at = 75;
  ForceLimits limits = {};
  std::map<std::string, bool> less_is_better = {};   ///< of the metrics that the rubric judges
  std::optional<Trace> trace = {};
  std::string no_trace = {};  ///< why there is none
  bool picture = false;       ///< the program can make one
  bool heat = false;          ///< and maps on the scene
  bool heat_of_force = false; ///< which one is looked at
  FilmState film = {};
  std::string no_film = {};   ///< why none can be made
  double t_s = 0;             ///< moment looked at, s after the trace's beginning
  std::map<std::string, std::string> metric_words = {};
  std::vector<Signature> signatures = {};
  std::vector<VerdictOverride> overrides = {};  ///< newest first
  std::vector<Rating> ratings = {};
  std::vector<Note> notes = {};
  std::vector<Rival> rivals = {};
  std::optional<Judgement> ready = {};  ///< evidence for a certificate
  std::string rules_version = {};
  double begin_s() const { return trace && !trace->samples.empty() ? trace->samples.front().t_s : 0; }
};

struct CompareView {
  std::string exercise = {};
  AttemptView left = {}, right = {};
  std::string left_words = {}, right_words = {};
  double t_s = 0;   ///< moment of the first that is looked at, s after its beginning
  int aligned = 0;  ///< shared mark at which they lie on each other, from 1; 0: each one's beginning
};

/// Who would pass with the rules or numbers as they stand in the editor.
struct PassPreview {
  std::string trainee = {}, exercise = {}, level = {}, why = {};
  bool passes_now = false, would_pass = false;
};

struct BenchmarkQuestion {
  std::string exercise_id = {}, level = {}, metric = "score", who = {}, rule = "mean-2sd", fixed = {}, zero_at = {};
};

struct BenchmarkProposal {
  BenchmarkQuestion asked = {};
  std::string problem = {};  ///< why there is no number
  std::string source = {};   ///< who the n were
  std::optional<double> value = {}, mean = {}, deviation = {};
  int n = 0;
  std::vector<PassPreview> preview = {};
};

struct GroupView {
  std::string name = {};
  std::vector<std::string> members = {};
};

struct CurriculumView {
  std::vector<Curriculum> versions = {};  ///< newest first
  std::string name = "standard", text = {}, problem = {}, saved = {};
  std::optional<std::vector<PassPreview>> preview = {};
  std::vector<Benchmark> benchmarks = {};
  std::optional<BenchmarkProposal> proposal = {};
  std::vector<GroupView> groups = {};
  std::vector<std::string> trainees = {}, levels = {}, hands = {};
  std::vector<Choice> exercises = {};
};

}  // namespace trocar::review
