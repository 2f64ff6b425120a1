// T6: how one learns: every exercise, level and input that was tried, and the way out of the program for one's own
// numbers (CSV).
//
// Thread: the window's.
#pragma once

#include "app/window/pages/progress_page.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"

namespace trocar {

class ProgressScreen : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  bool takes_escape() const override { return true; }

 private:
  std::optional<std::vector<ProgressEntry>> entries_;
  std::string language_, trainee_;
  ProgressPage page_;
};

/// What there is to show of whoever is here, newest curve first.
std::vector<ProgressEntry> progress_of(const PracticeModel& model);
/// All attempts of whoever is here into the exports folder beside the database. @return the file. @throws
/// EnvironmentError.
std::filesystem::path export_attempts(const PracticeModel& model);

}  // namespace trocar
