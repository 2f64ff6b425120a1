// How somebody learns an exercise at a level: scores in order, own median and quartiles, passes in a row, time spent.
//
// Attempts of another input (mouse, pad, device) or graded by another rubric are another curve: their scores do not
// compare. Pure. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/progress/past_attempts.h"

namespace trocar {

/// Median and quartiles; between two values in proportion (type 7 of Hyndman and Fan 1996).
struct Quartiles {
  double low = 0, median = 0, high = 0;
};
std::optional<Quartiles> quartiles(std::vector<double> values);

/// What attempts must share to be compared.
struct CurveKey {
  std::string exercise_id, level, hand, rubric_sha256;
  auto operator<=>(const CurveKey&) const = default;
};

inline constexpr int kBandAttempts = 10;  ///< newest scores that the own band is made of

struct LearningCurve {
  CurveKey key;
  std::vector<PastAttempt> attempts;  ///< that were tried, oldest first; what the device ended is not among them
  int graded = 0, passed = 0;
  int in_a_row = 0;                  ///< newest attempts passed
  double trained_s = 0;              ///< of the exercise's clock, over all that have one
  std::optional<double> best, last;  ///< scores
  std::optional<Quartiles> band;     ///< of the newest kBandAttempts scores, from three on
  std::vector<bool> passes() const;  ///< oldest first; one that was left counts as failed
};

/// One curve a key, in the order of the last attempt, newest first. @param newest_first of one trainee.
std::vector<LearningCurve> learning_curves(const std::vector<PastAttempt>& newest_first);

/// Median of a metric over the graded attempts, and the best: the one nearest full marks.
struct OwnValues {
  int count = 0;
  std::optional<double> best, median;
};
OwnValues own_values(const std::vector<PastAttempt>& attempts, const std::string& metric, bool less_is_better);

/// RFC 4180: one line an attempt in the order given, one column a metric that any of them has; UTF-8, CRLF, numbers to
/// the bit.
std::string attempts_csv(const std::vector<PastAttempt>& attempts);

}  // namespace trocar
