// The clock of a replay: where it stands, how fast it goes, what it repeats.
//
// Seconds since RUN began, so that two runs share it. Pure. Thread: plain value, any.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace trocar {

class ReplayClock {
 public:
  static constexpr double kStep_s = 0.04;  ///< of comma and full stop
  static constexpr std::array<double, 5> kSpeeds{0.25, 0.5, 1, 2, 4};

  /// The first range also says where it stands. @param to_s not before from_s.
  void set_range(double from_s, double to_s);
  /// @param known_s what is further has not been run again yet: the clock waits there.
  void advance(double dt_s, double known_s);
  /// At the end it begins again.
  void toggle_play();
  void pause() { playing_ = false; }
  void go(double t_s);
  /// Stands still and moves by whole steps.
  void step(int steps);
  /// To the next mark, or the one before; a mark less than half a second behind counts as where it stands. @return
  /// false: there is none.
  bool jump(const std::vector<double>& marks_s, int direction);
  void change_speed(int by);
  /// First A, then B (from then on it repeats what lies between), then neither.
  void next_loop_point();

  double now_s() const { return now_s_; }
  double from_s() const { return from_s_; }
  double to_s() const { return to_s_; }
  double speed() const { return kSpeeds[speed_]; }
  bool playing() const { return playing_; }
  std::optional<double> loop_a_s() const { return a_s_; }
  std::optional<double> loop_b_s() const { return b_s_; }

 private:
  double from_s_ = 0, to_s_ = 0, now_s_ = 0;
  bool ranged_ = false, playing_ = true;
  std::size_t speed_ = 2;
  std::optional<double> a_s_, b_s_;
};

}  // namespace trocar
