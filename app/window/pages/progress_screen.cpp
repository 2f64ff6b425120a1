#include "app/window/pages/progress_screen.h"

#include <algorithm>
#include <ctime>

#include "app/window/attempt/cut_off.h"
#include "app/window/attempt/file_stamp.h"
#include "app/window/attempt/metric_words.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"
#include "trainees/files/write_file.h"

namespace trocar {
namespace {

std::filesystem::path exports_folder(const PracticeModel& model) {
  const std::filesystem::path database = model.database();
  return (database == ":memory:" ? default_database_path() : database).parent_path() / "exports";
}

std::vector<AttemptSummary> newest_first(const LearningCurve& curve) {
  std::vector<AttemptSummary> out;
  for (auto a = curve.attempts.rbegin(); a != curve.attempts.rend(); ++a) out.push_back(a->summary);
  return out;
}

ProgressEntry entry_of(const PracticeModel& model, LearningCurve curve) {
  const Translator& w = model.words();
  ProgressEntry out;
  const CurveKey key = curve.key;
  const auto& all = model.exercises();
  const auto exercise =
      std::find_if(all.begin(), all.end(), [&](const Exercise& e) { return e.id == key.exercise_id; });
  out.name = key.exercise_id + " " + key.level;
  bool counts = false;
  if (exercise != all.end()) {
    out.name = exercise->number + " " + w.made(exercise->title) + " " + key.level;
    const ExerciseLevel* level = level_named(*exercise, key.level);
    out.pass_at = level ? level->rubric.pass_at : exercise->rubric.pass_at;
    counts = !curve.attempts.empty() && exercise->names(key.rubric_sha256, curve.attempts.back().summary.started_utc);
    out.older_rubric = exercise->rubric.sha256 != key.rubric_sha256;
  }
  out.input = hand_words(w, key.hand);
  const std::vector<AttemptSummary> summaries = newest_first(curve);
  out.in_a_row = passes_in_a_row(summaries);
  out.open = counts && opens_next(summaries);
  out.cusum = cusum(curve.passes());
  const auto cut = std::find_if(summaries.begin(), summaries.end(), [](const AttemptSummary& a) { return a.cut_off; });
  if (cut != summaries.end())
    out.note = cut_off_words(w, exercise == all.end() ? key.exercise_id : exercise->number, *cut, std::time(nullptr));
  out.curve = std::move(curve);
  return out;
}

}  // namespace

std::vector<ProgressEntry> progress_of(const PracticeModel& model) {
  std::vector<ProgressEntry> out;
  for (LearningCurve& curve : learning_curves(model.past())) out.push_back(entry_of(model, std::move(curve)));
  return out;
}

std::filesystem::path export_attempts(const PracticeModel& model) {
  const std::filesystem::path folder = exports_folder(model);
  make_owner_folders(folder);
  const std::string name = "trocar-" + model.trainee() + "-" + file_stamp();
  std::filesystem::path file = folder / (name + ".csv");
  for (int n = 2; std::filesystem::exists(file); ++n) file = folder / (name + "-" + std::to_string(n) + ".csv");
  write_owner_file(file, attempts_csv(model.past()));
  return file;
}

std::optional<ScreenName> ProgressScreen::frame(Ui& ui, PracticeModel& model, double /*dt_s*/) {
  using Kind = ProgressChoice::Kind;
  const Translator& w = model.words();
  if (!entries_ || language_ != w.language() || trainee_ != model.trainee()) {
    entries_ = progress_of(model);
    language_ = w.language();
    trainee_ = model.trainee();
  }
  const ProgressChoice choice = page_.draw(ui, *entries_, model.is_guest() ? model.who() : model.trainee());
  switch (choice.kind) {
    case Kind::kNone:
      break;
    case Kind::kBack:
      return ScreenName::kBack;
    case Kind::kOpen:
      return model.open_result(choice.uuid) ? std::optional(ScreenName::kDebrief) : std::nullopt;
    case Kind::kExport:
      try {
        model.notice = w("Your attempts were written to {0}", {export_attempts(model).string()});
      } catch (const EnvironmentError& error) {
        model.notice = w("The export failed: {0}", {error.what()});
      }
      break;
  }
  return std::nullopt;
}

}  // namespace trocar
