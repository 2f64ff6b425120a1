// Turns what hands do to mouse, keys, pad or SpaceMouse into where a person's hand wants the instrument (HandIntent).
//
// The intent pulls the simulated device's stylus through the impedance of the hand: nothing here sets the stylus.
// Movements are in the picture's plane about the view's own axes; depth is along the line of sight. Speeds are limited,
// and the target stays in a ball about the work space. The wrist turns the shaft about the tip: its far end goes where
// the hand goes, within what the device's wrist can follow (steering_reach.h); roll is about the shaft. Through a port
// only tip and roll can be had.
//
// One button acts: it presses the closed tip on to what lies below and into it, or closes the jaws where something is
// to be gripped. Held, the force grows; let go, it stays, also on tissue that relaxes; a click lets off. Over a ground
// the tip glides at a height. Where instruments are worked in tissue the jaws have a control of their own: held, they
// close, and let go, they open; act presses with closed jaws. Pedal and exchange switch are handed on as they are held,
// but that no instrument is exchanged which presses or holds something: the next one would stand in the tissue.
// Frame T, m, rad. Same events and same steps give the same intents. Thread: the window's.
#pragma once

#include <memory>
#include <string>

#include "app/picture/scene/scene_view.h"
#include "app/window/input/glide_ground.h"
#include "app/window/input/input_event.h"
#include "app/window/input/key_map.h"
#include "app/window/input/scope_hand.h"
#include "app/window/input/steering_reach.h"
#include "scenarios/hands/hand.h"

namespace trocar {

struct SteeringOptions {
  bool left_handed = false;     ///< wrist of mouse, sticks and SpaceMouse mirrored; left column for the panel
  bool like_a_fulcrum = false;  ///< a movement of the hand moves the tip the other way, as through a real port
  double sensitivity = 1;       ///< 0.25 to 4
};

/// What the hand is at, as the newest moment and the exercise say.
struct AtHand {
  HandIntent now = {};                  ///< where the hand has got to: the tip and the fingers
  bool jaws = true;                     ///< something is to be gripped: the act button closes the jaws, else it presses
  bool in_tissue = false;               ///< instruments are worked in tissue: act presses, a pad's triggers are
                                        ///< jaws and pedal
  bool jaws_apart = false;              ///< there, and the instrument in hand has jaws
  bool touching = false;                ///< the instrument feels a force
  Vec3 normal_T = Vec3::UnitZ();        ///< out of what it touches
  double force_n = 0;                   ///< and how hard
  bool gripping = false;                ///< so do the jaws,
  double grip_n = 0;                    ///< and how hard
  bool in_use = false;                  ///< the instrument presses or holds something: it is not exchanged
  bool scope = false;                   ///< it is the scope: leaning turns the view to where the hand goes
  const GlideGround* ground = nullptr;  ///< to glide over
};
class Steering {
 public:
  Steering(const KeyMap& keys, const SteeringOptions& options);
  ~Steering();

  /// Other keys or options from now on; nothing is held afterwards.
  void retune(const KeyMap& keys, const SteeringOptions& options);
  /// Where the instrument is when steering begins (and after a restart). @param reach of the exercise:
  /// steering_reach().
  void begin(const Pose& X_TI, double jaw_opening_m, const Vec3& centre_T, const SteeringReach& reach = {});
  /// @return true when the event was one of steering; false: it may be a command (KeyMap::action_of) or nothing. A
  /// window that lost the focus releases all (false: others may care too), and the jaws keep what they hold.
  bool handle(const InputEvent& event);
  /// Moves what is held (keys, sticks) by dt and gives the newest intent. @param camera axes of the picture.
  /// @param height_px of the scope's picture, for the mouse.
  /// @param around what the hand is at; its default: nothing is touched, jaws in use, no ground.
  const HandIntent& advance(double dt_s, const Camera& camera, double height_px, const AtHand& around = {});
  const HandIntent& intent() const;

  /// Whether the exchange switch has just been pressed in vain. A press that was refused stays so until it is let go.
  bool refuses_exchange() const;
  InputKind kind() const;  ///< what moved the hand last
  /// Below the tip on the ground that it glides over; nothing: it moves along the view.
  std::optional<Vec3> foot_T() const;
  using ScopeMove = trocar::ScopeMove;
  ScopeMove scope() const;             ///< turned by the person: light post, about its port, depth
  void stop_scope_at(double depth_m);  ///< no deeper: something is in its way

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
