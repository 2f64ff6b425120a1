// What eyes are given in place of a hand's feeling: what is lit, how high the tip is, over which point, and how hard it
// presses.
//
// An outline of what is asked for, seen through shaft and edges; a plumb line with a ring at its foot, on what lies
// below the tip; left of the tip, where neither shaft nor target is, a bar of the force that counts now, with its band
// and limit, and a ring that fills with the time held. Painted over the picture, so that every preset has it. px of the
// window, frame T. Thread: the window's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/picture/display/hud_layout.h"
#include "app/picture/scene/scope_optics.h"
#include "app/session/session.h"

namespace trocar {

class Ui;

struct TipGuide {
  std::vector<std::vector<Vec3>> lit_T = {};  ///< lines
  Vec3 tip_T = Vec3::Zero();
  std::optional<Vec3> plumb_T = {};    ///< where the plumb line hangs, if not at the tip: middle of what is carried
  std::optional<Vec3> foot_T = {};     ///< below it on what it may fall on; nothing: no plumb line
  std::optional<ForceBar> force = {};  ///< while it may be seen
  double held = 0;                     ///< 0..1
  std::string to_go = {};              ///< to the start ball, in words, below it
};

/// Where the tip, or what it carries, touches: nothing while only the shaft leans on something.
/// @param hangs_T tip, or middle of what is carried
std::optional<Vec3> touched_at(const StylusState& stylus, const Vec3& hangs_T);

/// Outline of what the exercise asks for now: start ball, disc, pen, block or ring.
std::vector<std::vector<Vec3>> lit_outline(const SessionView& view, const Camera& camera);

/// Middle of its first line.
Vec3 middle_of(const std::vector<std::vector<Vec3>>& lit_T);

/// Where words stand by what is lit, px: below it, above, right, left, else below or above a message; where they
/// neither hide the tip nor it, if there is such a place. Never over a message or out of the window.
/// @param lit, words  without and with their margins; of `words` the size counts
/// @return nothing: there is no room
std::optional<HudBox> place_words(const HudBox& lit, const HudBox& words, const std::optional<Eigen::Vector2d>& tip,
                                  const HudBox& window, const std::vector<HudBox>& messages);

/// @param messages that are drawn over it: no word lies under one
void paint_tip_guide(Ui& ui, const ScopeOptics& optics, const TipGuide& guide,
                     const std::vector<HudBox>& messages = {});

}  // namespace trocar
