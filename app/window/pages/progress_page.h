// The page of one's own progress as it is drawn: a list of curves, one of them with pass line, own band and CUSUM.
// Knows no model.
//
// One curve an exercise, level, input and rubric: attempts by mouse and by device never share one. Thread: the
// window's, within a frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/window/ui/button_row.h"
#include "app/window/ui/ui.h"
#include "trainees/progress/cusum.h"
#include "trainees/progress/learning_curve.h"

namespace trocar {

struct ProgressEntry {
  LearningCurve curve = {};
  std::string name = {};   ///< "E02 Surface touch L1"
  std::string input = {};  ///< "mouse", in the person's words
  double pass_at = 75;
  int in_a_row = 0;           ///< passes on different boards, newest attempts
  bool open = false;          ///< three in a row were reached
  bool older_rubric = false;  ///< graded by another version of the exercise than the one of today
  std::vector<CusumPoint> cusum = {};
  std::string note = {};  ///< what else is to be known: an attempt was cut off
};

struct ProgressChoice {
  enum class Kind : std::uint8_t { kNone, kBack, kExport, kOpen } kind = Kind::kNone;
  std::string uuid = {};  ///< kOpen: the attempt
};

class ProgressPage {
 public:
  /// @param who is here.
  ProgressChoice draw(Ui& ui, const std::vector<ProgressEntry>& entries, const std::string& who);
  int chosen() const { return chosen_; }
  int chosen_attempt() const { return attempt_; }  ///< index in the curve

 private:
  void list(Ui& ui, const std::vector<ProgressEntry>& entries, const std::string& who);
  void details(Ui& ui, const ProgressEntry& entry);
  void curve_plot(Ui& ui, const ProgressEntry& entry, double height_at_720);
  void cusum_plot(Ui& ui, const ProgressEntry& entry, double height_at_720) const;
  std::vector<RowButton> foot_buttons(const Translator& w, const std::vector<ProgressEntry>& entries) const;
  ProgressChoice meant(const std::string& id, const std::vector<ProgressEntry>& entries) const;

  int chosen_ = 0, attempt_ = -1;
};

/// "Competence is shown ..." in one sentence.
std::string competence_words(const Translator& words, const std::vector<CusumPoint>& points,
                             const CusumRule& rule = {});

}  // namespace trocar
