// T1: the first page. Try as a guest, sign in, language and size; behind it the show scene, then the expert at work.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/picture/films/film_loop.h"
#include "app/window/practice/practice_model.h"
#include "app/window/practice/screen.h"
#include "app/window/words/translator.h"

namespace trocar {

class StartScreen final : public Screen {
 public:
  std::optional<ScreenName> frame(Ui& ui, PracticeModel& model, double dt_s) override;
  std::optional<Stage> stage(PracticeModel& model, int width, int height) override;
  bool takes_escape() const override { return asked_ != PracticeModel::CodeAsks::kNothing; }

 private:
  std::optional<ScreenName> guest_part(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> new_code_part(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> pin_part(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> sign_in(PracticeModel& model);
  std::optional<ScreenName> trainee_part(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> plays(Ui& ui, PracticeModel& model);
  std::optional<ScreenName> foot(Ui& ui, PracticeModel& model);
  void caption(Ui& ui, const PracticeModel& model) const;

  double t_s_ = 0;
  std::shared_ptr<const SceneView> scene_;
  std::unique_ptr<FilmLoop> film_;  ///< over the show scene, as soon as there is one
  std::vector<Language> languages_;
  std::string code_, pin_, wrong_;
  PracticeModel::CodeAsks asked_ = PracticeModel::CodeAsks::kNothing;  ///< before code_ is signed in
  bool pin_begins_ = false;                                            ///< its field takes the focus once
};

}  // namespace trocar
