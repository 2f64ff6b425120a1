// The fingers at the jaws when a button stands for them.
//
// Held, they close and go on closing: what is asked beyond the object is grip force. Let go, they keep the force that
// there is, also on tissue that thins and relaxes between them. Let off, they open. While nothing is to be gripped the
// jaws are closed, as a tip to touch with. m, s. Thread: plain value, any thread.
#pragma once

namespace trocar {

class JawFingers {
 public:
  static constexpr double kTightest_m = -0.010;       ///< the fingers press beyond what they hold
  static constexpr double kSpeed_m_per_s = 0.04;      ///< open to closed in half a second
  static constexpr double kWorkSpeed_m_per_s = 0.05;  ///< in tissue: 0.4 s
  static constexpr double kAhead_m = 0.002;           ///< of the fingers that are at the object
  static constexpr double kFollow = 0.02;             ///< m/s per N after what relaxes, at most
  static constexpr double kFollowFastest = 0.0012;    ///< m/s

  void begin(double opening_m);
  struct Wish {
    bool used = true;         ///< something is to be gripped
    bool close = false;       ///< held
    bool let_go = false;      ///< no longer held since this step: they stay where the fingers are
    bool open = false;        ///< let off
    bool gripping = false;    ///< the jaws feel something between them
    double fingers_m = 0.02;  ///< opening that the hand has reached
    double grip_n = 0;        ///< of what is between them
  };
  void advance(const Wish& wish, double dt_s);
  /// In tissue, with a control of their own: held, they close, else they are open; shut while the tip presses.
  struct Work {
    bool close = false;       ///< held
    bool shut = false;        ///< the tip presses: closed, not squeezing
    bool gripping = false;    ///< the jaws feel something between them
    double fingers_m = 0.02;  ///< opening that the hand has reached
  };
  void work(const Work& wish, double dt_s);
  /// From kTightest_m to what begin() was given, at least 20 mm.
  double opening_m() const { return opening_m_; }

 private:
  double widest_m_ = 0.02, opening_m_ = 0.02, kept_n_ = 0;
  bool opening_ = true, used_ = true;
};

}  // namespace trocar
