// One duct or vessel of a scene with all that is on it (rod, lumen, clips, its surface), what changes it for good, and
// the tubes of a recording, made again from those changes and the recorded nodes.
//
// A change is kept in bytes (TissueShape::changes) and told by arcs and in the rod's own frame, so that it means the
// same on a rod that lies elsewhere: what happens in a run and what playback shows are made by the same apply(). The
// path's first point is where its content comes from. T, SI. Thread: tissue task; a playback belongs to one thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/thin/clip.h"
#include "tissue/thin/duct_setup.h"
#include "tissue/thin/elastic_rod.h"
#include "tissue/thin/lumen.h"
#include "tissue/thin/rod_surface.h"
#include "tissue/tissue_shape.h"

namespace trocar {

struct DuctChange {
  enum class Kind : std::uint8_t {
    kCut,
    kTorn,
    kNicked,
    kClipped,
    kSealed,
    kAvulsed,
    kUnclipped,  ///< the clip at that arc came off
  } kind = Kind::kCut;
  std::int32_t duct = 0;  ///< index in the scene
  double arc_m = 0;
  double share = 1;                      ///< of width or round
  Vec3 offset_rod = Vec3::Zero();        ///< kClipped: of the clip's tips from the axis, in the rod's frame there
  Mat3 rotation_rod = Mat3::Identity();  ///< kClipped: of the clip in it
};

std::string duct_change_bytes(const DuctChange& change);
/// Whether a change of TissueShape::changes is a duct's, else it is a cut of the organ (cut_lattice.h).
bool is_duct_change(std::string_view bytes);
/// @throws InputError: bytes that are none
DuctChange parse_duct_change(std::string_view bytes);

struct DuctTube {
  DuctTube(const DuctSetup& setup, double step_s);

  /// @return whether anything came of it: a rod is not cut twice at one place
  bool apply(const DuctChange& change);
  /// A clip where an applier stands.
  static DuctChange clip_change(std::int32_t duct, const ElasticRod& rod, double arc_m, double share, const Pose& X_TI);
  /// Appends the nodes by their ids, which cuts do not change.
  void add_nodes(std::vector<NodePlace>& nodes_T) const;

  ElasticRod rod;
  Lumen lumen;
  ClipSet clips;
  RodSurface seen;
};

/// The tubes as they lie before anything has been done to them.
std::vector<SurfacePtr> drawn_tubes(std::span<const DuctSetup> ducts);

/// Tubes from recorded nodes.
class DuctPlayback {
 public:
  /// @param changes of the recording, those of ducts are taken. @throws InputError: one that is none of these ducts
  DuctPlayback(std::span<const DuctSetup> ducts, std::span<const std::string> changes);

  std::size_t nodes() const;
  /// @param nodes_T as many as nodes(), as add_nodes() told them
  std::vector<SurfacePtr> at(std::span<const NodePlace> nodes_T) const;

 private:
  std::vector<DuctTube> tubes_;
};

}  // namespace trocar
