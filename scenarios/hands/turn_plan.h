// A turn of the wrist: the shortest rotation between two orientations with the time course of a minimum-jerk movement.
// Fixed memory; does not allocate.
#pragma once

#include "haptics/quantities.h"

namespace trocar {

class TurnPlan {
 public:
  TurnPlan() = default;
  TurnPlan(const Mat3& R_from, const Mat3& R_to, double duration_s);
  Mat3 at(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  Mat3 R_from_ = Mat3::Identity();
  Vec3 axis_ = Vec3::UnitX();  ///< in the frame turned
  double angle_rad_ = 0, duration_s_ = 0.1;
};

/// How an instrument is held, as it differs from how it was held at first: a wrist rolls back the way that it came,
/// where the shortest rotation would lead past its stop.
class Wrist {
 public:
  struct Held {
    Vec3 shaft_T = Vec3::UnitZ();
    double roll_rad = 0;  ///< about the shaft, half a turn either way
  };

  /// Takes how it is held at first; later ones are no news.
  void begin(const Mat3& R_TI) {
    if (!begun_) R_TI_first_ = R_TI;
    begun_ = true;
  }
  Held held(const Mat3& R_TI) const;
  /// Of an intent, that may be beyond half a turn where the instrument itself cannot be.
  Held held(const Mat3& R_TI, const Held& near) const;
  Mat3 holding(const Held& held) const;

 private:
  Mat3 R_TI_first_ = Mat3::Identity();
  bool begun_ = false;
};

/// A turn that a wrist makes, with the time course of a minimum-jerk movement.
class WristPlan {
 public:
  WristPlan() = default;
  WristPlan(const Wrist& wrist, const Wrist::Held& from, const Wrist::Held& to, double duration_s)
      : wrist_(wrist), from_(from), to_(to), duration_s_(duration_s) {}
  Mat3 at(double t_s) const;
  double duration_s() const { return duration_s_; }

 private:
  Wrist wrist_;
  Wrist::Held from_, to_;
  double duration_s_ = 0.1;
};

/// Small rotation by a rotation vector, rad.
Mat3 rotation_by(const Vec3& rotation_vector);

}  // namespace trocar
