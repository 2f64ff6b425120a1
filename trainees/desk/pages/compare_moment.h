// Two attempts at the same moment: which moment that is, and the pictures of it beside each other.
//
// Moments are seconds of the first attempt after its beginning; the second's is later by shift_s. Thread: any.
#pragma once

#include <string>
#include <vector>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/views.h"

namespace trocar::review {

/// The n-th event of a type that both attempts have: a place at which they can be laid on each other.
struct SharedMark {
  std::string words = {};          ///< "Target held 3"
  double left_s = 0, right_s = 0;  ///< after each one's beginning
};

/// Of what went as it should (information): by the first attempt's time. What a person marked and messages are none.
std::vector<SharedMark> shared_marks(const AttemptView& left, const AttemptView& right);

/// By how much the second runs later, s. @param aligned number of a shared mark from 1; 0 or unknown: both from their
/// own beginning.
double shift_s(const std::vector<SharedMark>& marks, int aligned);

/// Number of the mark at which the exercise began in both, from 1; 0 without one.
int start_mark(const std::vector<SharedMark>& marks);

/// Pictures, one slider, steps, marks.
std::string compare_moment_section(const CompareView& view);

}  // namespace trocar::review
