// The head-up display of an attempt: bars and dial by the level's feedback mode, steps, counts, device and notices.
//
// Feedback modes: `always` keeps the force bar in sight; `band` shows it only outside the wanted band, with a notice
// over the picture; `after` never during the run. Hidden bars keep their place. Thread: any.
#pragma once

#include <string>

#include "app/picture/scene/scene_view.h"
#include "app/session/session.h"

namespace trocar {

/// @param trainee code; empty: a guest. @param camera of the picture: the dial's axes are those that the trainee sees.
Hud attempt_hud(const SessionView& view, const Camera& camera, const std::string& trainee);

/// Pose error as seen through the camera. @param X_TI_wanted pose that the instrument shall have.
PoseDial pose_dial(const Pose& X_TI, const Pose& X_TI_wanted, const Camera& camera);

}  // namespace trocar
