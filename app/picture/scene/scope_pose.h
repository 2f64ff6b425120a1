// Where a scope in its port looks: shaft, light post, tilted tip and camera head as one pose, and the camera that
// follows.
//
// View = T(port) R(shaft) T(depth) Rz(post) Rx(-tilt) Rz(head), axes x right, y down, z along the shaft into the body;
// with yaw and pitch 0 the shaft lies along +y of T, level. Post up (0): a tilted tip looks below the shaft. The notch
// sits in the scope and so turns against the camera head; the level tick shows where T's up is. Frame T, m, rad.
// Thread: pure.
#pragma once

#include "app/picture/scene/scene_view.h"

namespace trocar {

struct ScopePose {
  Vec3 port_T = Vec3::Zero();         ///< where the shaft passes the wall
  double yaw_rad = 0, pitch_rad = 0;  ///< of the shaft: to the right, up
  double depth_m = 0.10;              ///< port to lens
  double tilt_rad = 0;                ///< 0, or 30 degrees
  double post_rad = 0;                ///< light post: turns the tilted tip round the shaft
  double head_rad = 0;                ///< camera head: turns the picture
  double focus_m = 0.10;              ///< lens to what is looked at: sets the automatic gain
  double diagonal_fov_deg = 72;
};

/// The camera of a pose. The notch stands at -head; the level tick is there whenever "up" can be told.
Camera scope_camera(const ScopePose& pose);

/// Head angle at which the picture is level whatever the post does (the key for "level"); the pose's own where "up"
/// cannot be told.
double level_head_rad(const ScopePose& pose);

/// The pose, post up, whose picture is that of `camera`. @param tilt_rad of its tip. @param depth_m port to lens.
ScopePose scope_behind(const Camera& camera, double tilt_rad, double depth_m = 0.10);

}  // namespace trocar
