// The first minute: one small thing to do after the other, each judged by what has been done, never by the time.
//
// Frame T, SI units. Nothing is graded; what is said names the input in hand. Thread: the window's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/scene/scene_view.h"
#include "app/session/run_moment.h"
#include "app/window/input/key_map.h"
#include "app/window/input/scope_hand.h"
#include "app/window/words/translator.h"

namespace trocar {

class Tutorial {
 public:
  enum class Step : std::uint8_t {
    kMove,
    kOver,
    kLower,
    kPress,
    kKeep,
    kLetOff,
    kLook,
    kLevel,
    kAgain,
    kRaise,
    kGrip,
    kOpen
  };
  static constexpr int kSteps = 12;

  struct Seen {
    const RunMoment& moment;
    Vec3 below_T;  ///< what lies below the tip
    ScopeMove scope;
  };
  /// Looks at a moment. @param dt_s since the last one. @return the step that this one completes.
  std::optional<Step> see(const Seen& seen, double dt_s);
  Step step() const { return static_cast<Step>(step_); }  ///< while not over()
  /// All is done, and has been praised.
  bool over() const { return step_ == kSteps; }

  struct Said {
    std::string message, hint;
    bool warning = false, done = false;
  };
  /// In few words what has been learnt, what is, and what will be.
  std::vector<HudStep> list(const Translator& words) const;
  /// While not over().
  Said says(const Translator& words, const KeyMap& keys, InputKind kind) const;

 private:
  bool done(const Seen& seen, double dt_s);
  bool held(bool so, double dt_s, double wanted_s);

  int step_ = 0;
  double held_s_ = 0, praise_s_ = 0;
  DirectorStatus status_;                                   ///< newest
  bool beside_ = false, rests_ = false, too_much_ = false;  ///< touching, but not the disc; under, over the band
};

}  // namespace trocar
