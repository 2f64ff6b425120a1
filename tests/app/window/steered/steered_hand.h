// A scripted hand at a mouse and a keyboard: what it wants becomes events as a person's hands would send them, which go
// the way of the window's own, through Steering and PersonHand, to an instrument that no device holds.
//
// It proves that an exercise can be done by mouse and keys, not that it can be done by who sees only the picture: its
// aims are the script's, from its Percept. It looks at the instrument sixty times a second and moves the mouse by whole
// pixels, the wheel by whole notches, and keys by holding them; what it knows of speeds and of the picture's scale is
// what practice teaches. Where the script would lean on tissue the mouse yields as an arm does, slowly. Frame T, SI.
// Thread: the session's, in lockstep.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "app/session/run_moment.h"
#include "app/session/setup/scene.h"
#include "app/window/attempt/person_hand.h"
#include "app/window/attempt/surroundings.h"
#include "app/window/input/steering.h"
#include "scenarios/hands/hand.h"

namespace trocar::testing_support {

class SteeredHand final : public Hand {
 public:
  /// @param newest as the window has it; both outlive this. @param script whose intents it follows.
  SteeredHand(const Scene& scene, const RunMoment& newest, std::unique_ptr<Hand> script);
  HandIntent update(const Percept& percept, double dt_s) override;

 private:
  bool is_behind(double dt_s);
  Percept as_eased(Percept percept);
  void look();
  void turn(const Mat3& wanted_TI, const Camera& camera);
  void move(const Vec3& to_T, const Camera& camera, bool glides);
  void use_jaws(double wanted_m, const AtHand& around);
  void hold(Action action, bool down);
  void send(InputEvent event);

  const Scene& scene_;
  const RunMoment& newest_;
  std::unique_ptr<Hand> script_;
  HandLink link_;
  PersonHand person_;
  Surroundings surroundings_;
  KeyMap keys_;
  Steering steering_;
  HandIntent wants_;
  bool steers_ = false;
  double waited_s_ = 0;
  double since_s_ = 0, x_ = 640, y_ = 360;
  double lets_off_s_ = 0;  ///< left of a key that is tapped
  std::uint64_t frames_ = 0, number_ = 0;
  Vec3 yields_T_ = Vec3::Zero();  ///< m, to what pushes back
  double grip_yields_m_ = 0, wanted_jaw_m_ = 0;
  std::map<Action, bool> held_;
};

}  // namespace trocar::testing_support
