#include "app/window/pages/progress_screen.h"

#include <algorithm>
#include <ctime>

#include "app/window/attempt/cut_off.h"
#include "app/window/attempt/file_stamp.h"
#include "app/window/attempt/metric_words.h"
#include "haptics/input_error.h"
#include "trainees/files/owner_file.h"

namespace trocar {
namespace {

std::filesystem::path exports_folder(const PracticeDesk& desk) {
  const std::filesystem::path database = desk.database();
  return (database == ":memory:" ? default_database_path() : database).parent_path() / "exports";
}

std::vector<AttemptSummary> newest_first(const LearningCurve& curve) {
  std::vector<AttemptSummary> out;
  for (auto a = curve.attempts.rbegin(); a != curve.attempts.rend(); ++a) out.push_back(a->summary);
  return out;
}

ProgressEntry entry_of(const PracticeDesk& desk, LearningCurve curve) {
  const Words& w = desk.words();
  ProgressEntry out;
  const CurveKey key = curve.key;
  const auto& all = desk.exercises();
  const auto exercise =
      std::find_if(all.begin(), all.end(), [&](const Exercise& e) { return e.id == key.exercise_id; });
  out.name = key.exercise_id + " " + key.level;
  if (exercise != all.end()) {
    out.name = exercise->number + " " + w.made(exercise->title) + " " + key.level;
    const ExerciseLevel* level = level_named(*exercise, key.level);
    out.pass_at = level ? level->rubric.pass_at : exercise->rubric.pass_at;
    out.older_rubric = exercise->rubric.sha256 != key.rubric_sha256;
  }
  out.input = hand_words(w, key.hand);
  const std::vector<AttemptSummary> summaries = newest_first(curve);
  out.in_a_row = passes_in_a_row(summaries);
  out.open = opens_next(summaries);
  out.cusum = cusum(curve.passes());
  const auto cut = std::find_if(summaries.begin(), summaries.end(), [](const AttemptSummary& a) { return a.cut_off; });
  if (cut != summaries.end())
    out.note = cut_off_words(w, exercise == all.end() ? key.exercise_id : exercise->number, *cut, std::time(nullptr));
  out.curve = std::move(curve);
  return out;
}

}  // namespace

std::vector<ProgressEntry> progress_of(const PracticeDesk& desk) {
  std::vector<ProgressEntry> out;
  for (LearningCurve& curve : learning_curves(desk.past())) out.push_back(entry_of(desk, std::move(curve)));
  return out;
}

std::filesystem::path export_attempts(const PracticeDesk& desk) {
  const std::filesystem::path folder = exports_folder(desk);
  make_owner_folders(folder);
  const std::string name = "trocar-" + desk.trainee() + "-" + file_stamp();
  std::filesystem::path file = folder / (name + ".csv");
  for (int n = 2; std::filesystem::exists(file); ++n) file = folder / (name + "-" + std::to_string(n) + ".csv");
  std::ofstream out = open_owner_file(file);
  out << attempts_csv(desk.past());
  out.close();
  if (!out) throw EnvironmentError(file.string() + ": cannot be written; is there room, and may you write there?");
  return file;
}

std::optional<ScreenName> ProgressScreen::frame(Ui& ui, PracticeDesk& desk, double /*dt_s*/) {
  using Kind = ProgressChoice::Kind;
  const Words& w = desk.words();
  if (!entries_ || language_ != w.language() || trainee_ != desk.trainee()) {
    entries_ = progress_of(desk);
    language_ = w.language();
    trainee_ = desk.trainee();
  }
  const ProgressChoice choice = page_.draw(ui, *entries_, desk.is_guest() ? desk.who() : desk.trainee());
  switch (choice.kind) {
    case Kind::kNone:
      break;
    case Kind::kBack:
      return ScreenName::kBack;
    case Kind::kOpen:
      return desk.open_result(choice.uuid) ? std::optional(ScreenName::kDebrief) : std::nullopt;
    case Kind::kExport:
      try {
        desk.notice = w("Your attempts were written to {0}", {export_attempts(desk).string()});
      } catch (const EnvironmentError& error) {
        desk.notice = w("The export failed: {0}", {error.what()});
      }
      break;
  }
  return std::nullopt;
}

}  // namespace trocar
