// A rigid or soft thing in the picture that is not the organ: task board, foam block, ring, pen, port, clip, drop.
//
// Frame O: the object's own; X_TO places it in T. Metres; colours are linear reflectances, 0..1. Thread: plain value.
#pragma once

#include <array>
#include <cstdint>

#include "haptics/quantities.h"

namespace trocar {

struct SceneObject {
  enum class Shape : std::uint8_t {
    kBox,       ///< rounded box about the origin; size: its three edges
    kCylinder,  ///< along z about the origin; size: diameter, -, length
    kRing,      ///< round z about the origin; size: outer diameter, -, thickness of the wire
    kPen,       ///< like frame I: tip at the origin, body towards -z, roll fin towards +y; size: diameter, -, length
    kSphere,    ///< size: diameter
    kBoard,     ///< slab below z = 0 with printed marks on its upper face; size: edges, thickness
    kSleeve,    ///< port: open tube along z with a slanted end at the origin, head at -length; size: bore, -, length
    kClip,      ///< closed V of wire, frame C of tissue/thin/clip.h; size: width, gap between the legs, length
    kTriangle,  ///< prism along z about the origin, one side towards -y, with a round hole; size: side, hole, height
    kCup,       ///< open along +z, middle of the rim at the origin; size: bore, outer diameter, inner depth
  } shape = Shape::kBox;
  enum class Look : std::uint8_t { kPlastic, kFoam, kSteel, kBoard } look = Look::kPlastic;
  /// State is told by shape as well as by colour: a waiting ghost is broken into dashes, a lit one is whole and pulses.
  enum class Style : std::uint8_t { kSolid, kLit, kGhost, kGhostLit, kGhostDone } style = Style::kSolid;

  Pose X_TO;
  Vec3 size_m = Vec3::Constant(0.01);
  Vec3 colour = Vec3(0.5, 0.5, 0.5);
  Vec3 accent = Vec3(0.05, 0.05, 0.05);  ///< marks: pen tip and roll fin, board lines, bands of a block
  int bands = 0;                         ///< foam: bands round the block, so that its class is not told by colour alone
  /// Soft bodies: jaws at +-`pinch_O` from the body's middle have each moved inwards by half of `pinch_depth_m`.
  Vec3 pinch_O = Vec3::UnitY();  ///< unit
  double pinch_depth_m = 0;
  double wear = 0;  ///< 0 as new, 1 crushed for good: creased and darkened
};

/// True for what light passes through.
bool is_ghost(const SceneObject& object);

/// Look of foam by crush class, gentlest first: colour and number of bands (linear; the catalogue's yellow is
/// ochre here, because bright yellow is what is lit).
struct FoamClass {
  Vec3 colour, band;
  int bands;
};
const std::array<FoamClass, 3>& foam_classes();

}  // namespace trocar
