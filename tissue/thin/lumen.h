// The lumen of a rod: where it is open, pressed, clipped, sealed by heat or cut, and where it opens to the outside.
//
// What closes it is kept by arcs, which a cut does not change, so nothing needs to be told of cuts. A network of flow
// reads segments() and ends() after each step. SI. Thread: tissue task.
#pragma once

#include <cstdint>
#include <vector>

#include "tissue/thin/elastic_rod.h"

namespace trocar {

enum class LumenState : std::uint8_t { kOpen, kPressed, kClipped, kSealed, kCut };

struct LumenSegment {
  std::size_t segment = 0;  ///< of the rod, between nodes segment and segment + 1
  LumenState state = LumenState::kOpen;
  double open = 1;      ///< of its area, 0 closed .. 1
  double flow = 1;      ///< of its laminar flow at the same pressure, 0 .. 1
  double holds_pa = 0;  ///< where it is closed: overpressure up to which it stays so
  double radius_m = 0;  ///< inside, where nothing closes it
  double length_m = 0;  ///< now
};

/// An end of a piece of the rod.
struct LumenEnd {
  std::size_t part = 0, node = 0;
  double arc_m = 0;
  bool outside = false;  ///< opens to the outside; else it goes on in what it hangs on
  Vec3 place_T = Vec3::Zero(), outward_T = Vec3::UnitZ();
};

/// A hole in the wall.
struct LumenLeak {
  double arc_m = 0, share = 0;  ///< of the round that is open
};

struct LumenOptions {
  double seal_holds_pa = 40000;     ///< 300 mmHg; sealed vessels hold that and more (unchecked)
  double pressed_holds_pa = 20000;  ///< between pads (unchecked)
};

class Lumen {
 public:
  explicit Lumen(const LumenOptions& options = {}) : options_(options) {}

  /// Before a step: nothing presses any more.
  void begin();
  /// From outside, until the next begin(). @param angle of the pads' normal from d1 towards d2, rad
  void press(double from_m, double to_m, double flatness, double angle);
  /// A clip. @param width_share of the duct's width that it closes @return a number to open it again by
  int clip(double from_m, double to_m, double width_share, double holds_pa, double angle);
  void open(int number);
  /// Heat has welded the walls. @param quality 0 nothing .. 1 whole
  void seal(double from_m, double to_m, double quality);
  /// Blades have opened the wall but not cut it through. @param share of the round
  void nick(double arc_m, double share);

  std::vector<LumenSegment> segments(const ElasticRod& rod) const;
  std::vector<LumenEnd> ends(const ElasticRod& rod) const;
  const std::vector<LumenLeak>& leaks() const { return leaks_; }

  /// The shape of the outline at an arc; runs out over a diameter beside what squeezes it.
  struct Shape {
    double flatness = 0, angle = 0;
  };
  Shape shape_at(const ElasticRod& rod, double arc_m) const;

 private:
  struct Closure {
    int number = 0;
    LumenState state = LumenState::kPressed;
    double from_m = 0, to_m = 0;
    double open = 1, flow = 1, holds_pa = 0;
    double flatness = 0, angle = 0;
  };
  LumenOptions options_;
  std::vector<Closure> closures_;
  std::vector<LumenLeak> leaks_;
  int next_ = 1;
};

}  // namespace trocar
