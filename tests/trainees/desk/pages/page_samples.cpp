#include "tests/trainees/desk/pages/page_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar::review {

Frame sample_frame() {
  Frame frame;
  frame.who = "Dr Ines Okafor";
  frame.token = "token-4711";
  frame.now_utc = "2026-03-20T10:00:00Z";
  frame.pdf = false;  // pages offer a PDF where the desk has one
  return frame;
}

Judgement judged(Flag flag, const std::string& evidence, int n) { return {flag, evidence, n, "1"}; }

CohortEntry sample_line(const std::string& code, const std::vector<double>& scores,
                        const std::vector<Judgement>& judgements) {
  CohortEntry line;
  line.code = code;
  line.exercise_id = "surface-touch";
  line.exercise = "Surface touch";
  line.level = "L2";
  line.hand = "mouse";
  line.scores = scores;
  line.tries = static_cast<int>(scores.size());
  if (!scores.empty()) {
    line.best = *std::max_element(scores.begin(), scores.end());
    line.last = scores.back();
  }
  line.judgements = judgements;
  line.last_utc = "2026-03-1" + std::to_string(scores.size() % 10) + "T09:30:00Z";
  return line;
}

CohortView sample_cohort() {
  CohortView view;
  view.groups = {"2026 A", "2026 B"};
  view.levels = {"L1", "L2", "L3"};
  view.exercises = {{"surface-touch", "Surface touch"}, {"limited-grasp", "Limited grasp"}};
  view.any_attempt = true;
  view.rules_version = "1";
  const auto add = [&](const std::string& code, const std::vector<double>& scores, double peak_n, int over,
                       const std::vector<Judgement>& why) {
    view.lines.push_back(sample_line(code, scores, why));
    view.lines.back().peak_force_n = peak_n;
    view.lines.back().over_force = over;
  };
  add("alvarez", {45, 52, 60, 63, 70, 72, 83, 65}, 1.1, 2, {judged(Flag::kLearning, "")});
  add("brandt", {60, 66, 78, 84, 88, 91, 95, 93, 92, 95, 94, 96, 91, 95, 93, 92}, 0.8, 0,
      {judged(Flag::kReady, "14 passes in a row, reliability 0.84", 16)});
  add("chen", {33, 45, 48, 44, 52, 59, 66, 70, 60, 63, 74, 64, 71, 70, 68, 72}, 1.5, 0,
      {judged(Flag::kStuck, "16 attempts without a pass", 16),
       judged(Flag::kPlateau, "+0.4 points over the newest 6", 6)});
  add("dubois", {50, 56, 49, 49, 59, 49, 70}, 6.3, 9,
      {judged(Flag::kUnsafe, "3 of the last 5 attempts went past 4.7 N")});
  add("eriksen", {80, 85, 88, 86, 90, 82, 70, 66, 82}, 1.2, 1,
      {judged(Flag::kRelapsed, "failures rose after competence was shown on 2 Feb", 9)});
  add("farouk", {71, 75, 80, 83}, 0.9, 0, {judged(Flag::kLearning, "")});
  add("gupta", {60, 55, 49, 52, 49}, 5.5, 4,
      {judged(Flag::kUnsafe, "2 of the last 5 attempts went past 4.7 N"),
       judged(Flag::kStuck, "5 attempts without a pass")});
  add("h\xC3\xB8yer", {77, 83, 81, 86, 90, 92}, 0.9, 0,
      {judged(Flag::kRetentionDue, "certificate of 1 Mar: attempt due 15 Mar", 1)});
  return view;
}

TraineeView sample_trainee() {
  TraineeView view;
  view.code = "bo";
  view.groups = {"2026 A"};
  view.rules_version = "1";
  CurveView curve;
  curve.key = {"surface-touch", "L2", "mouse", std::string(64, 'a')};
  curve.title = "Surface touch";
  const std::vector<double> scores = {33, 45, 48, 44, 52, 59, 66, 70, 60, 63, 76, 64, 78, 79, 68, 81};
  std::vector<bool> passes;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const std::string day = std::to_string(10 + i);
    curve.points.push_back(
        {"uuid-" + std::to_string(i + 1), "2026-03-" + day + "T09:00:00Z", "completed", scores[i], scores[i] >= 75});
    passes.push_back(scores[i] >= 75);
    const double middle = 40 + 45 * (1 - std::exp(-static_cast<double>(i) / 5));
    curve.cohort.push_back({static_cast<int>(i) + 1, 8 - static_cast<int>(i) / 3, {middle - 9, middle, middle + 7}});
  }
  curve.points[11] = {"uuid-12", "2026-03-21T09:00:00Z", "aborted", {}, false};
  curve.best = 81;
  curve.last = 81;
  curve.graded = 15;
  curve.passed = 4;
  curve.in_a_row = 1;
  curve.trained_s = 1260;
  curve.cusum = cusum(passes);
  curve.judgements = {judged(Flag::kPlateau, "+1.2 points over the newest 6 attempts", 6)};
  curve.reliability = 0.62;
  curve.benchmark = Benchmark{
      "b1", "surface-touch", "L2", "score", "input expert", "mean - 2 SD", "ines", "2026-02-01T08:00:00Z", 88.5, 0, 6};
  view.curves = {curve, curve, curve};
  view.curves[1].key = {"surface-touch", "L1", "mouse", std::string(64, 'b')};
  view.curves[1].judgements = {judged(Flag::kReady, "14 passes in a row", 16)};
  view.curves[2].key = {"limited-grasp", "L1", "device", std::string(64, 'c')};
  view.curves[2].title = "Limited grasp";
  view.curves[2].benchmark.reset();
  view.curves[2].cohort.clear();
  view.minutes_by_week = {{"2026-02-23", 12}, {"2026-03-02", 34}, {"2026-03-09", 0}, {"2026-03-16", 21}};
  view.notes = {{"n2", "bo", "uuid-9", "ines", "Dr Ines Okafor",
                 "Good exposure.\nTraction too strong at 92 s; repeat L1 first.", "2026-03-19T16:00:00Z", ""},
                {"n1", "bo", "", "ines", "Dr Ines Okafor", "Welcome.", "2026-03-10T16:00:00Z", "2026-03-11T08:00:00Z"}};
  view.certificates = {{"c1", "bo", "surface-touch", "L1", "1", "14 passes in a row, n = 16", "ines", "Dr Ines Okafor",
                        "2026-03-01T10:00:00Z", "", ""},
                       {"c0", "bo", "limited-grasp", "L1", "1", "14 passes in a row, n = 15", "ines", "Dr Ines Okafor",
                        "2026-02-01T10:00:00Z", "2026-02-03T10:00:00Z", "Device was out of calibration"}};
  view.due = {{"Surface touch", "L1", "2026-03-15T10:00:00Z", "14 days after the certificate", true},
              {"Surface touch", "L1", "2026-08-31T10:00:00Z", "183 days after the certificate", false}};
  return view;
}

Trace sample_trace(double peak_n) {
  Trace trace;
  trace.rate_hz = 100;
  for (int i = 0; i <= 6000; ++i) {
    TraceSample s;
    s.t_s = 0.01 * i;
    const double angle = 2 * std::numbers::pi * s.t_s / 20;
    s.tip_T = Vec3(0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.001 * s.t_s);
    s.contact = s.t_s >= 20 && s.t_s <= 40;
    s.force_T = Vec3(0, 0, s.contact ? peak_n * (1 - std::abs(s.t_s - 30) / 10) : 0);
    s.grip_n = s.contact ? 0.8 : 0;
    trace.samples.push_back(s);
  }
  return trace;
}

namespace {
RunReport sample_run_report() {
  RunReport device;
  device.backend = "simulated";
  device.rate_hz = 1000;
  device.ticks = 60000;
  device.overruns = 2;
  device.kappa = 0.5;
  device.warnings = {{"sensor stale", 0.25, 12}};
  device.realtime =
      R"({"kernel":"Linux 6.1.0","kernel_realtime":false,"processors":2,"load":2.06,"memory_locked":true,"processors_awake":true,"lanes":{
      "haptic":{"policy":"SCHED_FIFO 80","processor":1,"rate_hz":999.96,"wakes":60000,"missed":2,"overruns":0,
      "longest_gap_ms":3.2,"late_us":{"p50":12,"p99":31,"p99.9":96,"max":2214,"bins":{"7":200,"10":40000,"15":19000,
      "30":780,"70":19,"2000":1}},"period_us":{"p50":1001,"p99":1020,"p99.9":1090,"max":3214,"off_bins":{"-2000":1,
      "-70":10,"-10":2000,"-3":9000,"0":40000,"3":8000,"10":980,"70":9,"2000":1}},"cpu_us":{"p50":41,"p99":72,
      "p99.9":95,"max":326,"bins":{"30":50000,"50":9900,"70":99,"300":1}}}}})";
  return device;
}
}  // namespace

AttemptView sample_attempt(double score, double peak_n) {
  AttemptView view;
  AttemptResult& r = view.result;
  r.uuid = "01890000-aaaa-7bbb-8ccc-000000000001";
  r.exercise_id = "surface-touch";
  r.exercise_version = "1.0";
  r.level = "L2";
  r.seed = 42;
  r.board = 3;
  r.trainee = "dubois";
  r.hand = "mouse";
  r.started_utc = "2026-03-19T09:30:00.000Z";
  r.rubric_sha256 = std::string(64, 'a');
  r.recording_sha256 = std::string(64, 'b');
  r.state_hash = "0123456789abcdef";
  r.organ_name = "liver";
  r.organ_synthetic = true;
  r.organ_credit = "Synthetic phantom, CC0-1.0";
  r.grade.status = AttemptStatus::kCompleted;
  r.grade.score = score;
  r.grade.passed = score >= 75;
  r.grade.grade = r.grade.passed ? "pass" : "below pass";
  r.grade.subscores = {{"in_band", 0.4, 0.35, 0.58, "share", 1, 0.3, true},
                       {"excess", 0.5, 0.25, 3.0, "count", 0, 6, true},
                       {"time", 0.9, 0.4, 36, "s", 30, 90, false}};
  if (!r.grade.passed) r.grade.caps = {{.kind = CapKind::kGate, .subject = "in_band", .below = 0.5, .at_most = 59}};
  r.grade.metrics = {
      {"time_s", 60, "s"}, {"force_max_n", peak_n, "N"}, {"path_m", 0.377, "m"}, {"tremor", std::nullopt, "mm"}};
  r.events = {{12.5, "TARGET_HELD", Severity::kInfo, 0, 1.1, "N", Vec3(0.01, 0, 0)},
              {27.0, "OUT_OF_VIEW", Severity::kMinor, -1, 0, "", Vec3::Zero()},
              {30.0, "EXCESS_FORCE", Severity::kMajor, 2, peak_n, "N", Vec3(0, 0.02, 0)}};
  r.device = sample_run_report();
  view.exercise = "Surface touch";
  view.program = "trocar 0.7";
  view.row_hash = std::string(64, 'd');
  view.chain_position = 77;
  view.limits = {0.4, 0.8, 1.5};
  view.trace = sample_trace(peak_n);
  view.picture = true;
  view.t_s = 30;
  view.metric_words = {{"force_max_n", "largest |F| of the scene on the instrument over the whole attempt"}};
  view.signatures = {{"s1", view.row_hash, "a1", "Dr Ines Okafor", "review", "seen together", "2026-03-19T17:00:00Z"}};
  view.notes = {{"n1", "dubois", r.uuid, "ines", "Dr Ines Okafor", "Let go when the bar turns orange.",
                 "2026-03-19T17:01:00Z", ""}};
  view.rivals = {{"own best", "01890000-aaaa-7bbb-8ccc-000000000002", 70.0},
                 {"expert", "01890000-aaaa-7bbb-8ccc-000000000003", 97.8}};
  view.rules_version = "1";
  return view;
}

CompareView sample_compare() {
  CompareView view;
  view.exercise = "Surface touch L2";
  view.left = sample_attempt();
  view.right = sample_attempt(97.8, 0.8);
  view.right.result.uuid = "01890000-aaaa-7bbb-8ccc-000000000003";
  view.right.result.trainee = "expert";
  view.right.result.hand = "expert";
  view.right.result.grade.subscores[0].value = 1;
  view.left_words = "dubois, 19 Mar";
  view.right_words = "expert";
  return view;
}

CurriculumView sample_curriculum() {
  CurriculumView view;
  view.versions = {{"u2", "standard", std::string(64, 'e'), "version = \"2\"\n", "ines", "2026-03-02T10:00:00Z", 2},
                   {"u1", "standard", std::string(64, 'f'), "version = \"1\"\n", "", "2026-02-02T10:00:00Z", 1}};
  view.text = "version = \"3\"\npasses_to_unlock = 4\n\n[cusum]\nadequate = 0.10\ninadequate = 0.25\n";
  view.preview = {{"brandt", "Surface touch", "L2", "14 passes in a row", true, true},
                  {"farouk", "Surface touch", "L2", "3 of 4 passes in a row", true, false}};
  view.benchmarks = {{"b1", "surface-touch", "L2", "score", "input expert", "mean - 2 SD", "ines",
                      "2026-02-01T08:00:00Z", 88.5, 0, 6}};
  BenchmarkProposal proposal;
  proposal.asked = {"surface-touch", "L2", "score", "hand:expert", "mean-2sd", "", ""};
  proposal.source = "input expert";
  proposal.value = 91.25;
  proposal.mean = 97.25;
  proposal.deviation = 3.0;
  proposal.n = 4;
  proposal.preview = {{"brandt", "Surface touch", "L2", "best 95.0", true, true}};
  view.proposal = proposal;
  view.groups = {{"2026 A", {"alvarez", "brandt", "chen"}}, {"2026 B", {"dubois"}}};
  view.trainees = {"alvarez", "brandt", "chen", "dubois"};
  view.levels = {"L1", "L2"};
  view.hands = {"expert", "mouse"};
  view.exercises = {{"surface-touch", "Surface touch"}};
  return view;
}

LiveStations sample_stations() {
  LiveStation running, idle;
  LiveMoment& now = running.told.moment;
  now = {.program = "practice window",
         .trainee = "dubois",
         .exercise_id = "surface-touch",
         .exercise = "EX2 Surface touch",
         .level = "L2",
         .hand = "mouse",
         .setup = "board 3, organ phantom-liver (synthetic)",
         .attempt = "01890000-aaaa-7bbb-8ccc-000000000009",
         .phase = "running"};
  now.elapsed_s = 65.2;
  now.limit_s = 120;
  now.force_n = 0.62;
  now.peak_force_n = 1.34;
  now.limit_n = 1.5;
  now.done = 7;
  now.count = 12;
  now.device = "simulated";
  now.device_state = "active";
  now.rate_hz = 999.7;
  now.missed = 0;
  now.hears = true;
  running.picture = "0192-aa.jpg";
  now.events = {{12.5, "Target done", false}, {44.1, "Too much force", true}};
  running.told.process = {4711, "boot", 99};
  running.told.machine = "lab-3";
  idle.told.moment.program = "practice window";
  idle.told.moment.trainee = "chen";
  idle.told.moment.phase = "between attempts";
  idle.told.moment.hears = true;
  idle.told.process = {4712, "boot", 100};
  return {{running, idle}, {}, ""};
}

}  // namespace trocar::review
