// What the desk's pages show, as plain values: a page is a function of one of these, so that every page is tested
// without a database.
//
// Scores 0..100, forces in virtual newtons, times of an attempt in seconds from its beginning, dates ISO 8601 UTC.
// Thread: any.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "trainees/desk/queries/film_state.h"
#include "trainees/desk/queries/losses.h"
#include "trainees/markup/board_plots.h"
#include "trainees/markup/plots.h"
#include "trainees/progress/judgement.h"
#include "trainees/records/assessments.h"
#include "trainees/records/curricula.h"
#include "trainees/records/verdicts.h"

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
  int graded = 0, passes = 0;
  std::optional<double> reliability = {};
  std::string rubric_sha256 = {};
  std::optional<Harm> harm = {};  ///< of those judged unsafe
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
  bool any_attempt = false;             ///< in the whole record
  int erased = 0;                       ///< people whose training data were erased: in no line and no count
  std::string rules_version = {}, rules_unread = {};
};

struct CurvePoint {
  std::string uuid = {}, utc = {}, status = {};
  std::optional<double> score = {};
  bool passed = false;          ///< as it counts
  std::int64_t number = 0;      ///< of the attempt in this database
  std::string decided_by = {};  ///< "" where the score decides
  bool passed_by_score = false;
  bool soft_real_time = false;  ///< its loop had no real-time priority
};

/// Quartiles of the cohort at the n-th attempt of each.
struct CohortBand {
  int attempt = 0, n = 0;
  Quartiles quartiles = {};
};

/// A measure by attempt, of one person or of a cohort alone.
struct MetricCurve {
  std::string name = {}, unit = {};
  std::string words = {};                          ///< what it is, "" where nobody says
  std::vector<std::optional<double>> values = {};  ///< by point of the curve; empty: the cohort alone
  std::vector<CohortBand> cohort = {};
  std::vector<std::string> choices = {};  ///< measures that could be asked for
};

/// Why attempts fail at one exercise, level, input and rubric.
struct LossLine {
  std::string title = {};
  Losses losses = {};
  MetricCurve metric = {};  ///< of the cohort; drawn where it has points
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

/// An attempt that the device ended: in no curve, yet in lists and files.
struct EndedAttempt {
  CurveKey key = {};
  CurvePoint point = {};
};

/// Rasch: where a trainee or an exercise stands, or the sentence that says what is missing.
struct AbilityView {
  std::optional<double> logit = {}, standard_error = {};
  int n = 0;  ///< own attempts that it rests on
  std::string missing = {};
};
struct DifficultyLine {
  std::string exercise = {}, level = {}, hand = {};
  double logit = 0, standard_error = 0;
  int n = 0;
};
struct DifficultyView {
  std::vector<DifficultyLine> lines = {};  ///< easiest first
  int attempts = 0;
  std::string missing = {}, rules_version = {};
};

struct DueDate {
  std::string exercise = {}, level = {}, utc = {}, why = {};
  bool over = false;
};

/// Certificates that are in question (trainees/records/certificate_standing.h): by number, why.
using ShakenCertificates = std::map<std::string, std::string>;

/// What is asked of "Why": group, exercise, level, and a measure to draw.
struct WhyView {
  CohortQuestion asked = {};
  std::string metric = {};
  std::vector<std::string> groups = {}, levels = {}, metrics = {};
  std::vector<Choice> exercises = {};
  std::vector<LossLine> lines = {};
};

struct TraineeView {
  ShakenCertificates shaken = {};
  std::string code = {}, name = {};
  std::vector<std::string> groups = {};
  std::vector<CurveView> curves = {};
  std::size_t chosen = 0;                           ///< curve that is drawn
  std::vector<EndedAttempt> ended_by_device = {};   ///< oldest first
  int page = 1;                                     ///< of the list of attempts
  std::map<std::string, std::string> reasons = {};  ///< why, by attempt of that page
  MetricCurve metric = {};                          ///< of the chosen curve
  std::vector<LossLine> losses = {};
  AbilityView ability = {};
  std::vector<std::pair<std::string, double>> minutes_by_week =
      {};                        ///< Monday's date, minutes; oldest first, no week left out
  std::vector<Note> notes = {};  ///< newest first
  std::vector<Certificate> certificates = {};
  std::vector<DueDate> due = {};
  bool erased = false;  ///< the training data: nothing is judged
  std::string rules_version = {};
  std::string created_utc = {};
};

/// Another attempt that this one may be laid over.
struct Rival {
  std::string words = {}, uuid = {};
  std::optional<double> score = {};
};

/// The newest decision on an attempt of a curve.
struct CurveDecision {
  std::string attempt_uuid = {};
  VerdictOverride decision = {};
};

/// A certificate that an attempt's page shows.
struct CitedCertificate {
  Certificate certificate = {};
  bool cites = false;            ///< this very attempt is its evidence
  std::string in_question = {};  ///< why it may not stand
  bool is_signed = true;         ///< else it keeps no other from being given
};

/// What page and paper say of one that is not as it was finished.
inline constexpr const char* kChangedAttempt =
    "This attempt is not as it was when it was finished, or its entry is not signed with the station's key: "
    "what stands here proves nothing. trocar db check names it.";

/// And of a note that no signed entry holds.
inline constexpr const char* kUnsignedNote =
    "Not signed with the station's key, or changed since: whoever may write the file can have put it in.";

struct AttemptView {
  AttemptResult result = {};
  std::int64_t number = 0;  ///< in this database
  std::string exercise = {}, program = {}, finished_utc = {}, row_hash = {};
  std::int64_t chain_position = 0;
  double pass_at = 75;
  ForceLimits limits = {};
  PoseLimits pose = {};                             ///< of pens
  std::vector<GripLimits> grips = {};               ///< of the board's blocks; read for reports
  std::map<std::string, bool> less_is_better = {};  ///< of the metrics that the rubric judges
  std::optional<Trace> trace = {};
  std::string no_trace = {};   ///< why there is none
  std::string recorded = {};   ///< of an attempt that was cut off: what its recording gives, for who decides on it
  bool picture = false;        ///< the program can make one
  bool heat = false;           ///< and maps on the scene
  bool heat_of_force = false;  ///< which one is looked at
  FilmState film = {};
  std::string no_film = {};  ///< why none can be made
  double t_s = 0;            ///< moment looked at, s after the trace's beginning
  std::map<std::string, std::string> metric_words = {};
  std::vector<Signature> signatures = {};
  std::vector<VerdictOverride> overrides = {};  ///< newest first
  std::vector<Rating> ratings = {};
  std::vector<Note> notes = {};
  bool changed = false;         ///< after it was finished, or no signed entry says that it was
  bool unsigned_words = false;  ///< one of these four, or a decision, is not signed by the station or was changed since
  std::vector<Rival> rivals = {};
  std::optional<Judgement> ready = {};  ///< evidence for a certificate
  std::vector<CitedCertificate> certificates =
      {};  ///< of this exercise and level, or that cite this attempt; newest first
  std::vector<CurveDecision> curve_decisions =
      {};                                 ///< of this trainee's attempts on the same curve, oldest attempt first
  std::vector<std::string> missing = {};  ///< conditions of a certificate that do not hold, a sentence each
  std::string rules_version = {};
  double late_share = 0.01;  ///< of ticks missed, above which the rules call an attempt late
  Verdict verdict() const {
    return verdict_of(result.grade.status, result.grade.passed,
                      overrides.empty() ? std::nullopt : std::optional(overrides.front()));
  }
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
  std::optional<bool> passes_now = false;  ///< nothing: there is nothing now to pass
  bool would_pass = false;
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
  bool set_by_person = false;              ///< a fixed number: n is 0, and that is no small sample
  std::optional<double> reliability = {};  ///< of the persons' means
  std::string rules_version = {};
  std::vector<PassPreview> preview = {};
};

struct GroupView {
  std::string name = {};
  std::vector<std::string> members = {};
};

struct CurriculumView {
  std::vector<Curriculum> versions = {};                ///< newest first
  std::map<std::string, std::string> own_version = {};  ///< that the text of a version gives itself, by its UUID
  std::map<std::string, std::string> authors = {};      ///< names by account
  DifficultyView difficulties = {};
  std::string rules_version = {};  ///< in force
  std::string rules_unread = {};   ///< why newer ones are not
  std::string name = "standard", text = {}, problem = {}, saved = {};
  std::string seen_name = {}, seen = {};  ///< name that the form was made from, UUID of its newest version
  std::optional<std::vector<PassPreview>> preview = {};
  std::vector<Benchmark> benchmarks = {};
  std::optional<BenchmarkProposal> proposal = {};
  std::vector<GroupView> groups = {};
  std::vector<std::string> trainees = {}, levels = {}, hands = {};
  std::vector<Choice> exercises = {};
};

}  // namespace trocar::review
