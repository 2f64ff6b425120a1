// What the instructor's desk is told of this window, and what it says in return.
#include <algorithm>

#include "app/window/practice/practice_model_state.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr double kAskEvery_s = 1;  // for messages
constexpr const char* kProgram = "practice window";

}  // namespace

/// News at once, the rest when the desk wants it.
void PracticeModel::State::tell_desk(bool guest) {
  const std::string who = guest ? "" : trainee;
  if (!runner || play != Play::kAttempt) {
    if (told || told_phase.empty() || told_trainee != who) {
      LiveMoment idle;
      idle.program = kProgram;
      idle.hears = true;
      idle.trainee = told_trainee = who;
      idle.phase = told_phase = "between attempts";
      told.reset();
      live->tell(idle);
    }
    return;
  }
  if (!told || told->moment().attempt != runner->attempt()) {
    LiveMoment beginning = live_beginning(runner->scene(), kProgram, who, runner->attempt());
    beginning.hears = true;
    told.emplace(std::move(beginning));
    told_phase.clear();
  }
  if (const RunMoment& moment = runner->newest(); moment.seen)
    told->see(view_of(runner->scene(), moment), runner->paused(), LiveAttempt::Clock::now());
  else if (runner->paused())
    told->see_paused();
  if (told->moment().phase == told_phase && !live->wanted()) return;
  told_phase = told->moment().phase;
  live->tell(told->moment());
}

bool PracticeModel::desk_wants_picture() {
  const State& s = *state_;
  return s.live && s.runner && s.play == Play::kAttempt && s.live->picture_wanted();
}

void PracticeModel::show_desk(Image picture) {
  constexpr int kQuality = 75;
  if (state_->live) state_->live->show([picture = std::move(picture)] { return encode_jpeg(picture, kQuality); });
}

/// A database that does not answer is asked again.
void PracticeModel::State::look_for_message() {
  if (message) return;
  try {
    message = AssessmentStore(*database).unseen_message(trainee);
  } catch (const EnvironmentError&) {
  }
}

/// @return whether it was shown: it has then been met.
bool PracticeModel::State::show_message(std::string& notice) {
  const bool runs = runner && !runner->finished();
  if (!message || !notice.empty() || (runs && runner->scene().level.name == kExamLevel)) return false;
  const Note shown = *std::exchange(message, std::nullopt);
  try {
    AssessmentStore(*database).mark_seen(shown.uuid);
  } catch (const EnvironmentError&) {
    return false;  // it comes again
  }
  notice = shown.printed.empty() ? words("Your teacher writes: {0}", {shown.text})
                                 : words("{0} writes: {1}", {shown.printed, shown.text});
  if (runs && runner->newest().status.phase == Phase::kRun) runner->mark_message();
  if (!note || note->uuid == shown.uuid) note = shown;  // it also stands on the course's page until the next attempt
  return true;
}

void PracticeModel::pass(double dt_s) {
  State& s = *state_;
  if (s.database->in_memory()) return;
  if (!s.live) s.live = std::make_unique<LivePublisher>(s.database->file());
  s.tell_desk(is_guest());
  s.unasked_s += dt_s;
  if (!is_guest() && s.unasked_s >= kAskEvery_s) {
    s.unasked_s = 0;
    s.look_for_message();
  }
  if (!is_guest()) s.show_message(notice);
}

}  // namespace trocar
