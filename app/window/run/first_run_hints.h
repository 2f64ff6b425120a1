// Three marks that tell a guest in a first attempt what moves what; each is ticked when it has been done once.
//
// Thread: the window's.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/window/input/key_map.h"
#include "app/window/words/translator.h"

namespace trocar {

class FirstRunHints {
 public:
  struct Hint {
    std::string text;
    bool done = false;
  };

  /// @param wanted false: it has nothing to say.
  void begin(bool wanted);
  void saw(const InputEvent& event, const KeyMap& keys);
  /// While something is still to be tried, and a little longer.
  bool speaks() const { return wanted_ && over_s_ < kLinger_s; }
  void pass(double dt_s);
  std::vector<Hint> marks(const Translator& words, const KeyMap& keys, InputKind kind) const;

 private:
  static constexpr double kLinger_s = 2;
  bool all() const { return done_[0] && done_[1] && done_[2] && done_[3]; }
  void acts(bool held);

  bool wanted_ = false;
  std::array<bool, 4> done_{};  ///< moved, deeper, pressed or gripped, let off
  bool acting_ = false;
  double acted_s_ = 0;
  double way_px_ = 0, last_x_ = -1, last_y_ = -1, over_s_ = 0;
};

}  // namespace trocar
