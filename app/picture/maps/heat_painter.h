// A map of an attempt painted on a picture of its scene: grey scene, viridis over it where there is something to show,
// and its scale.
//
// Frame T. Same trace, same scene: same bytes. Thread: that of the renderer for what it needs of it; the rest any.
#pragma once

#include "app/picture/gl/image.h"
#include "app/picture/maps/heat_field.h"
#include "app/picture/maps/seen_places.h"
#include "app/picture/scene/scene_view.h"

namespace trocar {

/// Fields over the organ (in space) and over boards (along them).
struct HeatFields {
  HeatFields(const Trace& trace, HeatOf what) : of(what), space(trace, what, false), flat(trace, what, true) {}
  double at(const SeenPlaces& seen, int x, int y) const;

  HeatOf of;
  HeatField space, flat;
};

/// A camera from which the whole organ, or the whole board, is seen.
Camera overview_camera(const SceneView& view);

/// The scene as it is painted on: without display, instrument, what moves, lit targets.
SceneView bare_scene(SceneView view);

/// The most that is seen of the fields through any of the cameras: the top of the scale. 0: nothing.
double heat_top(const HeatFields& fields, const SceneView& view, const std::vector<Camera>& cameras);

/// @param picture of bare_scene(view) through view.camera; painted over.
void paint_heat(Image& picture, const SceneView& view, const HeatFields& fields, double top);

inline constexpr double kLeastShown = 0.02;  ///< of the top: below it the scene stays grey

}  // namespace trocar
