// Throws of a knot: what a surgeon ties with the two limbs of a thread that leave a stitch.
//
// A throw is one limb led round the other once or more and drawn through. Its sense is that of the Gauss linking of
// both limbs, each told outwards from the stitch: it is the same from wherever one looks, and whichever limb moved.
// Alternating senses make a square knot, the same sense again a granny; two turns first, a surgeon's knot. Where one
// limb stayed straight while the other went round it, it is a half hitch, which slides.
//   ThrowWatch   sees it tied: a limb wound round the instrument's shaft, the other limb taken by its jaws, the turns
//                slipped off over them. This needs no contact of the thread with itself
//   read_throws  reads it from where both limbs lie
// Thread: tissue task; pure functions and plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

struct Throw {
  int turns = 1;
  int sense = 1;       ///< +1 or -1
  bool hitch = false;  ///< one limb stayed straight

  bool operator==(const Throw&) const = default;
};

enum class KnotKind : std::uint8_t { kNone, kHalfKnot, kSquare, kSurgeons, kGranny, kSlip };
KnotKind knot_kind(std::span<const Throw> throws);
/// "square knot".
const char* knot_name(KnotKind kind);

struct KnotHold {
  double first_n = 0.15, double_first_n = 0.6;  ///< of the first throw, of one turn and of more
  double square_n = 3.0;                        ///< that each throw adds which alternates,
  double granny_n = 0.8;                        ///< which has the sense of the last one,
  double hitch_n = 0.2;                         ///< or which is a half hitch; all unchecked
};
/// Pull at which a knot that is drawn tight slips, N.
double holding_force(std::span<const Throw> throws, const KnotHold& hold = {});

/// Turns of a line about the z axis of a frame, right-handed, of what of it lies within `within_m` of the axis between
/// two heights. @param line in T
double turns_about(std::span<const Vec3> line_T, const Pose& X_TI, double from_z, double to_z, double within_m);

/// Gauss linking of two open lines: the sum over all pairs of segments (Klenin and Langowski 2000). Of closed ones it
/// is a whole number. @return for each segment of `a`, what it has of it
std::vector<double> linking(std::span<const Vec3> a, std::span<const Vec3> b);

/// Throws in the order in which they lie outwards from the stitch.
/// @param a, b the limbs, outwards, not drawn so tight that throws lie on one another
std::vector<Throw> read_throws(std::span<const Vec3> a, std::span<const Vec3> b);

/// Limbs of the thread: towards the needle, and the tail.
enum class Limb : std::uint8_t { kLong, kTail };

class ThrowWatch {
 public:
  struct Seen {
    std::span<const Vec3> long_T, tail_T;  ///< outwards from the stitch
    Pose X_TI;                             ///< of the instrument
    std::optional<Limb> held;              ///< by its jaws
  };
  /// After a step. @return the throw that has just been drawn through
  std::optional<Throw> step(const Seen& seen);
  void reset();

  double turns() const { return turns_; }  ///< round the shaft now
  bool caught() const { return caught_; }  ///< with them on it, the jaws hold the other limb

 private:
  double turns_ = 0;
  bool caught_ = false;
  Limb wound_ = Limb::kLong;
  Throw next_;
};

}  // namespace trocar
