// The fingers at the jaws when a button or a trigger stands for them.
//
// Held closed, the wanted opening goes from open to 0 in 0.4 s, then on slowly: intent beyond what is held is grip
// force. Released it opens at the same speed unless it is latched. Latched, closing and `fine` are slow (5 mm/s), so
// that a grip force can be had by eye. A trigger says the opening itself. m, s. Thread: plain value, any thread.
#pragma once

namespace trocar {

class JawFingers {
 public:
  static constexpr double kTightest_m = -0.010;  ///< the fingers press beyond what they hold
  static constexpr double kRampTime_s = 0.4;
  static constexpr double kSlow_m_per_s = 0.005;

  void begin(double opening_m);
  struct Wish {
    bool close = false, open = false, fine = false;
    double trigger = 0;  ///< 0..1
  };
  void advance(const Wish& wish, double dt_s);
  /// Holds what is held; a second time lets it go.
  void toggle_latch();
  /// Keeps the opening as it is, whatever is released now.
  void hold();
  bool latched() const { return latched_; }
  double opening_m() const { return opening_m_; }

 private:
  double widest_m_ = 0.02, opening_m_ = 0.02;
  bool latched_ = false;
};

}  // namespace trocar
