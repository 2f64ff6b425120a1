#include "app/cli/attempts/board_play.h"

#include <atomic>
#include <mutex>

#include "app/cli/in_parallel.h"
#include "app/cli/progress_display.h"
#include "app/cli/text_table.h"
#include "app/session/playback/expert_run.h"
#include "app/session/recording/recording_reader.h"
#include "app/session/session.h"
#include "scenarios/files/exercise_loader.h"
#include "scenarios/layout/board_numbers.h"
#include "scenarios/scoring/trace.h"

namespace trocar {
namespace {

std::string refusal_of(const Grade& grade) {
  if (grade.status != AttemptStatus::kCompleted) return std::string("the expert ended it ") + status_name(grade.status);
  return grade.passed ? "" : "the expert finished it with " + cell(grade.score, 1) + " and did not pass";
}

/// Plays until somebody stops it.
class BoardPlay {
 public:
  BoardPlay(const AssetRoots& assets, std::ostream& err) : assets_(assets), progress_(err, error_is_terminal()) {}

  void play(const AttemptSetup& setup, PlayedBoard& board, std::size_t of) {
    if (stop_) return;
    const auto file = expert_recording(setup, assets_, [this] { return stopped(); });
    if (file.empty()) return;
    const Grade grade = grade_recording(read_recording(file), file.string()).grade;
    board = {setup.board, grade.status, grade.score.value_or(0), refusal_of(grade)};
    const std::lock_guard lock(mutex_);
    try {
      progress_.show("boards played", static_cast<double>(++done_) / static_cast<double>(of));
    } catch (const Interrupted&) {
      stop_ = true;
    }
  }
  /// @throws Interrupted.
  void end() {
    progress_.clear();
    if (stop_) throw Interrupted();
  }

 private:
  bool stopped() {
    const std::lock_guard lock(mutex_);
    if (watch_.seen()) stop_ = true;
    return stop_;
  }

  const AssetRoots& assets_;
  InterruptWatch watch_;
  std::mutex mutex_;  ///< guards the watch and what follows
  ProgressDisplay progress_;
  std::size_t done_ = 0;
  std::atomic<bool> stop_ = false;
};

}  // namespace

std::string PlayedLevel::why() const {
  std::string first;
  int failed = 0;
  for (const PlayedBoard& board : boards) {
    if (board.why.empty()) continue;
    if (failed++ == 0) first = "board " + std::to_string(board.board) + ": " + board.why;
  }
  return failed > 1 ? first + " (and " + std::to_string(failed - 1) + " more)" : first;
}

PlayedLevel play_level(const Exercise& exercise, const std::string& level, const std::string& organ,
                       const AssetRoots& assets, std::ostream& err) {
  PlayedLevel played{std::vector<PlayedBoard>(kPracticeBoards)};
  const bool exam = find_level(exercise, level).exam;
  AttemptSetup any;
  any.exercise = exercise;
  any.level = level;
  any.organ = organ;
  any.tissue = exercise.tissue;
  any.hand = "expert";
  BoardPlay play(assets, err);
  in_parallel(played.boards.size(), 0, [&](std::size_t k) {
    AttemptSetup setup = any;
    setup.seed = static_cast<std::int64_t>(k);
    setup.board = exam ? drawn_board(setup.seed, exam) : static_cast<int>(k);
    play.play(setup, played.boards[k], played.boards.size());
  });
  play.end();
  return played;
}

}  // namespace trocar
