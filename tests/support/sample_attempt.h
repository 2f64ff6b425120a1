// An attempt made by formula: five touches of one second each, one of them too strong. For report and review tests.
//
// Frame T, metres, newtons, seconds. Thread: any.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "scenarios/scoring/attempt_result.h"
#include "scenarios/scoring/trace.h"

namespace trocar::testing_support {

/// 20 s at 1 kHz; touch k peaks at 1.5 N, the fourth at 5.6 N.
inline Trace sample_trace() {
  Trace trace;
  for (int i = 0; i < 20000; ++i) {
    TraceSample s;
    s.t_s = 2.0 + 0.001 * i;
    const int touch = i / 4000;
    const double phase = (i % 4000) / 4000.0, angle = 1.3 * touch + 2.2 * phase * phase;
    s.tip_T = Vec3(0.03 * std::cos(angle) + 0.004 * touch, 0.025 * std::sin(angle),
                   0.02 * (1 - std::sin(std::numbers::pi * phase)));
    const double press = phase > 0.45 && phase < 0.75 ? std::sin((phase - 0.45) / 0.30 * std::numbers::pi) : 0.0;
    s.force_T = Vec3(0.1 * press, 0,
                     (touch == 3 ? 5.6 : 1.5) * std::sqrt(press) + (press > 0 ? 0.06 * std::sin(0.9 * i) : 0.0));
    s.contact = press > 0;
    s.grip_n = touch == 4 && phase > 0.8 ? 2.4 : 0;
    trace.samples.push_back(s);
  }
  return trace;
}

inline Grade sample_grade(bool passed) {
  Grade grade;
  grade.status = AttemptStatus::kCompleted;
  grade.score = passed ? 88.4 : 59.0;
  grade.passed = passed;
  grade.grade = passed ? "proficient" : "below pass";
  grade.subscores = {{"time_to_complete", 0.62, 0.15, 47.2, "s", 30, 75, false},
                     {"path_ratio", 0.71, 0.20, 1.9, "1", 1.3, 3.4, false},
                     {"peak_force", passed ? 0.95 : 0.22, 0.30, passed ? 2.2 : 5.61, "N", 2.0, 6.0, true},
                     {"time_in_band_share", 0.84, 0.20, 0.78, "1", 0.9, 0.3, false},
                     {"wrong_places", 1.0, 0.15, 0.0, "count", 0, 3, false}};
  if (!passed) grade.caps = {{.kind = CapKind::kGate, .subject = "peak_force", .below = 0.5, .at_most = 59}};
  grade.metrics = {{"task_time", 47.2, "s"},
                   {"path_length", 0.612, "m"},
                   {"ideal_path_length", 0.322, "m"},
                   {"peak_force", 5.61, "N"},
                   {"mean_contact_force", 1.38, "N"},
                   {"time_in_band_share", 0.78, "1"},
                   {"excess_force_events", 1, "count"},
                   {"excess_force_impulse", 0.83, "N s"},
                   {"wrong_places", 0, "count"},
                   {"tip_speed_mean", 0.031, "m/s"},
                   {"spectral_arc_length", -4.21, "1"},
                   {"grip_peak", 2.4, "N"},
                   {"grip_hold_time", 1.02, "s"},
                   {"idle_share", {}, "1"},
                   {"contact_time", 6.02, "s"},
                   {"retract_height_mean", 0.0183, "m"}};
  return grade;
}

inline std::vector<Event> sample_events() {
  std::vector<Event> events;
  const auto event = [&](double t, const char* type, Severity severity, int object, double value, const char* unit) {
    Event e{
        t, type, severity, object, value, unit, Vec3(0.03 * std::cos(1.3 * object), 0.025 * std::sin(1.3 * object), 0)};
    events.push_back(e);
  };
  event(2.0, "RUN_START", Severity::kInfo, -1, 0, "");
  for (int k = 0; k < 5; ++k) {
    if (k == 3) event(2.0 + 4 * k + 2.1, "EXCESS_FORCE", Severity::kMajor, 3, 5.61, "N");
    event(2.0 + 4 * k + 2.9, "TARGET_HELD", Severity::kInfo, k, 1.0, "s");
  }
  event(21.5, "GRIP_HELD", Severity::kInfo, -1, 2.4, "N");
  event(21.99, "RUN_END", Severity::kInfo, -1, 0, "");
  return events;
}

inline AttemptResult sample_attempt(bool passed = false) {
  AttemptResult r;
  r.uuid = "7f1c7a52-0000-4000-8000-000000000007";
  r.exercise_id = "surface-touch";
  r.exercise_version = "3";
  r.level = "L1";
  r.seed = 7;
  r.board = 3;
  r.trainee = "T-014";
  r.hand = "intermediate";
  r.grade = sample_grade(passed);
  r.events = sample_events();
  r.device.backend = "simulated";  // by name: the run report grows
  r.device.rate_hz = 1000;
  r.device.ticks = 20000;
  r.device.saturated_contact_share = 0.012;
  r.device.passivity_active_share = 0.031;
  r.device.min_energy_j = -0.0004;
  r.device.kappa = 0.62;
  r.organ_name = "liver";
  r.organ_source = "phantom_ct.nrrd";
  r.organ_synthetic = true;
  r.organ_credit = "Synthetic CT phantom of the project, CC0-1.0";
  r.organ_sha256 = std::string(64, 'a');
  r.rubric_sha256 = std::string(64, 'b');
  r.recording_sha256 = std::string(64, 'c');
  r.state_hash = "0123456789abcdef";
  r.started_utc = "2026-01-02T03:04:05";
  return r;
}

}  // namespace trocar::testing_support
