// Everything that one picture shows: a plain snapshot, so that the renderer knows neither device nor exercise.
//
// Frame T, metres, z up, newtons. The renderer (renderer.h) draws it to an image; the head-up display reads `hud`.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/scene/scene_object.h"
#include "haptics/contact/instrument.h"
#include "haptics/quantities.h"
#include "tissue/surface_snapshot.h"
#include "tissue/tissue_frame.h"

namespace trocar {

/// Disc on the tissue that the trainee is to touch.
struct TargetMark {
  Vec3 centre_T = Vec3::Zero();
  Vec3 normal_T = Vec3::UnitZ();
  double radius_m = 0.003;
  enum class State : std::uint8_t { kWaiting, kLit, kDone } state = State::kWaiting;
};

/// One force bar: value, wanted band, hard limit, highest value so far.
struct ForceBar {
  std::string label;
  double value_n = 0, peak_n = 0;
  double band_low_n = 0, band_high_n = 0;
  double limit_n = 0;  ///< hatched zone starts here
  double full_scale_n = 0;
  bool hidden = false;           ///< feedback mode: the place is kept, but neither value nor track is shown
  std::string hidden_note = {};  ///< why, in its place
};

/// How far the instrument is from a wanted pose, as a trainee sees it: sideways, up and away from the lens.
struct PoseDial {
  Vec3 offset_C = Vec3::Zero();  ///< tip minus wanted tip, m: x right, y up, z away
  double position_error_m = 0, position_tolerance_m = 0;
  Vec3 lean_C = Vec3::Zero();  ///< shaft's direction minus the wanted one (towards the hand), rad; axes as above
  double roll_rad = 0;         ///< about the shaft
  double angle_error_rad = 0, angle_tolerance_rad = 0;  ///< of the whole rotation
  bool hidden = false;                                  ///< feedback mode: the place is kept, the note stands in it
  std::string hidden_note;
};

/// A short notice over the picture's upper edge: the state of device or mapping, or a force outside its band.
struct HudNotice {
  std::string text;
  enum class Kind : std::uint8_t { kInfo, kWarning, kTooMuch, kTooLittle } kind = Kind::kInfo;
};

struct HudStep {
  std::string text;
  enum class State : std::uint8_t { kOpen, kCurrent, kDone } state = State::kOpen;
};

struct HudRow {
  std::string name, value, unit;
  bool gauge = false;  ///< watched while one works: left out last
};

/// What the column says by itself, in the language that was chosen; {0} is a number.
struct HudLabels {
  std::string match = "Place and direction", force = "Force", steps = "Steps", so_far = "So far", device = "Device",
              tip = "Tip", angle = "Angle", error = "{0} of {1}", limit = "limit {0}", peak = "peak {0}",
              band = "band {0}", more = "+ {0} more after the run";
  std::string decimal = ".";
};

struct Hud {
  HudLabels labels = {};
  std::string trainee;                ///< "Trainee: T-expert"
  std::string title;                  ///< "E02 Surface touch - L1"
  double elapsed_s = 0, limit_s = 0;  ///< elapsed below 0: no clock
  std::vector<ForceBar> bars;
  std::optional<PoseDial> dial;
  std::vector<HudNotice> notices;  ///< the first two are shown
  std::vector<HudStep> steps;
  std::vector<HudRow> rows;                        ///< "So far"
  std::vector<HudRow> device;                      ///< device strip: "plant | simulated |", "loop | 1000 | Hz"
  std::string toast, toast_hint;                   ///< at most one message; empty when none
  bool toast_warning = false, toast_done = false;  ///< a triangle, a tick stands before it
  double toast_at = 1;  ///< 0 at the picture's upper edge .. 1 at the lower: where it covers nothing that is to be seen
  std::string credit;   ///< organ's origin and licence; says "synthetic" for phantoms
};

struct Camera {
  Vec3 eye_T = Vec3(0, -0.1, 0.1);
  Vec3 look_at_T = Vec3::Zero();
  Vec3 up_T = Vec3::UnitZ();
  double diagonal_fov_deg = 70;
  double notch_rad = 0;  ///< the field's notch, clockwise from 12 o'clock: it sits in the scope, not in the camera head
  std::optional<double> level_rad;  ///< small tick on the rim where "up" is, clockwise from 12 o'clock; empty: no tick
};

/// What lies on the scope's lens, 0 none .. 1 blind. @see TissueFrame
struct LensState {
  double fog = 0, blood = 0;
  double wipe = 0;  ///< share of the field that a wipe has cleaned, 0..1
};

/// An instrument beside the first one.
struct InstrumentView {
  Pose X_TI;
  double shaft_radius_m = 0.0025, shaft_length_m = 0.30;
  double jaw_opening_m = 0;
  bool roll_stripe = false;
  InstrumentKind kind = InstrumentKind::kGrasper;
};

/// An organ beside the one in the middle.
struct AdjacentOrganView {
  SurfacePtr surface;    ///< in T; shared between frames
  std::string material;  ///< selects the look
};

/// A needle, a thread: thin and of no tissue.
struct WireView {
  SurfacePtr surface;  ///< in T, its vertices told round the wire
  SceneObject::Look look = SceneObject::Look::kSteel;
  Vec3 colour = Vec3::Constant(0.5);
  double wider_m = 0;  ///< all round: what is thinner than a pixel is not seen
};

struct SceneView {
  SurfacePtr organ;             ///< already in T; shared between frames
  std::string material;         ///< selects the tissue look: "liver", "gallbladder", ...
  std::string second_material;  ///< of the organ's second part (SurfaceSnapshot::part); empty: it has none
  std::vector<AdjacentOrganView> adjacent;
  std::vector<WireView> wires;
  std::vector<TargetMark> targets;
  std::vector<SceneObject> objects;  ///< board, blocks, rings, ghost pens, port
  Eigen::AlignedBox3d stage_T;       ///< without an organ: work space that the box trainer surrounds
  InstrumentKind instrument = InstrumentKind::kGrasper;
  Pose X_TI;  ///< instrument tip, z along the shaft towards the tip
  double shaft_radius_m = 0.0025, shaft_length_m = 0.30;
  double jaw_opening_m = 0;      ///< between the jaws' tips
  bool roll_stripe = false;      ///< paint a stripe along the upper jaw's side (+y of I)
  std::optional<Vec3> dimple_T;  ///< while touching: the side of the tip that presses; the shaft goes on from there
  Vec3 dimple_normal_T = Vec3::UnitZ();
  double dimple_depth_m = 0;  ///< drawn as a local dent under tip and shaft, with whitening
  std::vector<InstrumentView> more_instruments = {};
  std::vector<TissueMark> marks = {};  ///< blood, char, whitening, wet; the first kMaxTissueMarks are drawn
  double smoke_per_m = 0;              ///< extinction of the smoke
  LensState lens;
  Vec3 breath_T = Vec3::Zero();  ///< how far breathing has moved the organs just now, but for those that give way
  Camera camera;
  Hud hud;
};

}  // namespace trocar
