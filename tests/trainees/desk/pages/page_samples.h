// Views for pages: a small group with known numbers, an attempt with a known trace, hostile texts.
#pragma once

#include <string>

#include "trainees/desk/pages/pages.h"

namespace trocar::review {

/// A text that would run, break out of attributes, or split a header if it were not escaped.
inline constexpr const char* kHostile = "<script>alert(1)</script>\"'&\r\n\x01--></textarea>{\xC3\x28}";

Frame sample_frame();
Judgement judged(Flag flag, const std::string& evidence, int n = 5);
/// One line; passes at 75.
CohortEntry sample_line(const std::string& code, const std::vector<double>& scores,
                        const std::vector<Judgement>& judgements);
/// Eight trainees in all states.
CohortView sample_cohort();
/// 16 attempts of "bo" with quartiles, benchmark, notes, certificates, weeks.
TraineeView sample_trainee();
/// 60 s at 100 Hz: a circle of 20 mm radius in the plane, force up to `peak_n` at 30 s, contact from 20 to 40 s.
Trace sample_trace(double peak_n = 4);
AttemptView sample_attempt(double score = 58, double peak_n = 5.2);
CompareView sample_compare();
CurriculumView sample_curriculum();
/// Two programs: "dubois" in the middle of an attempt, "chen" between attempts.
LiveStations sample_stations();

}  // namespace trocar::review
