// Marks that tell a guest in a first attempt what moves what; each is ticked when it has been done once.
//
// Thread: the window's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/window/input/key_map.h"
#include "app/window/words/translator.h"
#include "scenarios/exercise.h"

namespace trocar {

class FirstRunHints {
 public:
  struct Hint {
    std::string text;
    bool done = false;
  };

  /// What the exercise asks for beyond moving.
  enum class Tries : std::uint8_t {
    kActs,   ///< press or grip, and let off
    kTurns,  ///< lean the shaft and roll it
    kRolls,  ///< through a port it cannot be leant
    kWorks   ///< in tissue: grip, exchange, pedal
  };

  /// @param wanted false: it has nothing to say.
  void begin(bool wanted, Tries tries = Tries::kActs);
  void saw(const InputEvent& event, const KeyMap& keys);
  /// While something is still to be tried, and a little longer.
  bool speaks() const { return wanted_ && over_s_ < kLinger_s; }
  void pass(double dt_s);
  std::vector<Hint> marks(const Translator& words, const KeyMap& keys, InputKind kind) const;

 private:
  static constexpr double kLinger_s = 2;
  bool all() const { return done_[0] && done_[1] && done_[2] && done_[3] && (done_[4] || tries_ != Tries::kWorks); }
  std::vector<Hint> working(const Translator& words, const KeyMap& keys, InputKind kind) const;
  void works(const InputEvent& event, std::optional<Action> action);
  void acts(bool held);
  void turns(const InputEvent& event, std::optional<Action> action);

  bool wanted_ = false;
  Tries tries_ = Tries::kActs;
  /// Moved, deeper; pressed or gripped and let off, or leant and rolled, or gripped, exchanged and the pedal pressed.
  std::array<bool, 5> done_{};
  bool acting_ = false, dragging_ = false;
  double acted_s_ = 0;
  double way_px_ = 0, last_x_ = -1, last_y_ = -1, over_s_ = 0;
};

/// What a level of an exercise asks of the hand.
FirstRunHints::Tries hand_tries(const Exercise& exercise, const ExerciseLevel& level);

}  // namespace trocar
