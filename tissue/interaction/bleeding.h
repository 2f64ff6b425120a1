// Wounds of an organ that bleed: onto its surface, in spurts through the air, until they clot, are pressed, clipped or
// coagulated. Every millilitre is accounted for.
//
//   ooze       q a (p - p_out) / (p0 - p_out): what a cut area a of tissue gives from its capillaries at the portal
//              pressure p; q is one number of the organ
//   vessels    of an organ with a known network (vessel_flow.h) those that are cut; of one without, vessels of a few
//              sizes that a cut meets once area and depth are large enough. How large hangs on the place at rest
//              alone: the same cut always meets the same, a deeper one the same and more
//   press      a tool that presses with p_e takes p_e from the driving pressure under it; 8 mmHg more than outside
//   stops
//              ooze, a small artery takes 80
//   clotting   ooze and small vessels fall exponentially, faster while they are pressed
//   spurts     of a jet that is fast enough a share leaves in drops along the surface's normal; the rest runs
//
// A step: circulation, flows, blood onto film and into the air, irrigation and suction, film, drops. Wounds are held by
// vertices, which keep their numbers when a cut makes more of them. Between steps coagulate() and press() take places
// of the surface as it was in the last step.
// Frame T, SI inside, the ledger in mL. Thread: tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "tissue/interaction/blood_drops.h"
#include "tissue/interaction/circulation.h"
#include "tissue/interaction/surface_film.h"
#include "tissue/interaction/vessel_flow.h"

namespace trocar {

/// A size of vessels in an organ whose network is not known.
struct VesselSize {
  Supply supply = Supply::kPortal;
  double radius_m = 0;
  double feed_m = 0;  ///< length of a tube of that radius with the resistance of all before the cut
  double per_m2 = 0;  ///< that a deep cut meets, of its area
  double from_depth_m = 0, full_depth_m = 0;  ///< none above, `per_m2` below
};

/// Liver. Numbers of vessels are a choice, unchecked; the flows lie in the grades of the intraoperative bleeding scale
/// (Lewis et al., Surgery 2017: mild 1 to 5, moderate 5 to 10, severe 10 to 50 mL/min).
std::vector<VesselSize> liver_vessels();

struct BleedingOptions {
  CirculationOptions circulation;
  SurfaceFilmOptions film;
  VesselFlowOptions flow;        ///< viscosity, jets and spasm, also of vessels without a network
  double ooze_m_per_s = 6.7e-4;  ///< q: 4 mL/min of 1 cm2 ("mild"); unchecked
  std::vector<VesselSize> vessels = liver_vessels();
  double patch_m = 0.005;           ///< edge of the cells of space that have one draw of vessels each
  double merge_m = 0.004;           ///< wounds nearer than that at rest are one
  double clot_s = 240;              ///< time constant: bleeding time is 2 to 9 min; unchecked
  double pressed_clots_faster = 4;  ///< unchecked
  double clots_up_to_m = 0.35e-3;   ///< radius of vessels that clot; unchecked
  double seals_up_to_m = 1.25e-3;   ///< radius of vessels that heat closes; unchecked
  double spurt_speed_m_per_s =
      0.5;                        ///< from which an arterial jet spurts: 13 mm high; portal branches do not; unchecked
  double spurt_share = 0.5;       ///< of its flow; unchecked
  double drop_m3 = 15e-9;         ///< 3 mm across
  double drop_speed_share = 0.4;  ///< of the jet's; unchecked
  double mean_over_s = 2;         ///< time constant of the rates that are told
};

using WoundId = std::int32_t;  ///< -1: none

struct WoundState {
  Vec3 place_T = Vec3::Zero();
  double area_m2 = 0, depth_m = 0;
  double oozing_m2 = 0;           ///< what of the area is neither clotted nor coagulated
  std::int32_t vessels = 0;       ///< cut vessels in it
  std::int32_t open_vessels = 0;  ///< of which bleed now
  double open_share = 0;          ///< of the lumen of the most open of those without a network
  bool pressed = false;           ///< in the last step
  double lost_ml = 0;
  double rate_ml_per_min = 0;  ///< mean of the last beats
};

struct BloodLedger {
  double lost_ml = 0;  ///< by all wounds
  double film_ml = 0, dried_ml = 0, pool_ml = 0, sucked_ml = 0, air_ml = 0;
  double water_given_ml = 0, water_film_ml = 0, water_pool_ml = 0, water_sucked_ml = 0, evaporated_ml = 0;
  double rate_ml_per_min = 0;  ///< mean of the last beats
  double blood_missing_ml() const { return lost_ml - film_ml - dried_ml - pool_ml - sucked_ml - air_ml; }
  double water_missing_ml() const {
    return water_given_ml - water_film_ml - water_pool_ml - water_sucked_ml - evaporated_ml;
  }
};

class Bleeding {
 public:
  explicit Bleeding(const TriangleSurface& rest_T, const BleedingOptions& options = {});
  /// Of an organ whose vessels are known: cuts then meet those of cut_vessel() alone, and ooze.
  Bleeding(const TriangleSurface& rest_T, const BleedingOptions& options, const VesselFlow& vessels);

  /// Vessels beside the organ's own: cut_vessel() and clip_vessel() name them; cuts of the organ do not meet them.
  /// Before any is cut.
  void hang(const VesselFlow& vessels) { whole_vessels_ = vessels_ = vessels; }

  /// @returns its number; that of a wound so near that this one widens it; -1 for a place that is not there or an area
  /// that is not positive
  WoundId add_wound(const MaterialPoint& place, double area_m2, double depth_m);
  WoundId add_wound(std::span<const std::int32_t> vertices, double area_m2, double depth_m);
  /// Opens a vessel of that size alone, without a cut: a wound of its own. @returns as add_wound()
  WoundId open_vessel(const MaterialPoint& place, const VesselSize& size);
  /// Opens a vessel of the network: its end at `from` bleeds at the one place, that at `to` at the other.
  /// @returns the first of two numbers that follow each other; -1 as above
  WoundId cut_vessel(std::int32_t vessel, double at, const MaterialPoint& from_end, const MaterialPoint& to_end);
  void clip_vessel(std::int32_t vessel, double at, double share);
  /// The clip at exactly that place came off.
  void unclip_vessel(std::int32_t vessel, double at);
  /// Jaws that press a share of its lumen shut there, until the next; 0: none.
  void pinch_vessel(std::int32_t vessel, double at, double share);
  /// On the vessels of a wound: 1 closes them, less lets some through. What of its faces is spanned oozes no longer.
  void clip_wound(WoundId wound, double share, double spanned_m2 = 0);
  /// Heat: takes this share of what still bleeds. Vessels that are too large stay as they are.
  void coagulate(WoundId wound, double share);
  /// Of all wounds within the radius, as far as it covers them.
  void coagulate(const Vec3& place_T, double radius_m, double share);
  /// In the next step; several add up.
  void press(const Vec3& place_T, double radius_m, double pressure_pa);
  void irrigate(const Irrigation& jet);
  void suck(const Suction& suction);
  /// @param vertices_T of the surface as it is now, as many as it has at rest
  void step(std::span<const Vec3> vertices_T, double step_s);
  /// @param inside of each triangle: the wall of a cut; empty: none is
  void grow(const TriangleSurface& rest_T, const std::vector<VertexOrigin>& added,
            const std::vector<bool>& inside = {});
  /// No wound, no blood, all vessels whole; the surface stays as it is.
  void reset();

  const std::vector<float>& blood() const { return film_.blood(); }  ///< 0 .. 1 at every vertex
  const std::vector<float>& wet() const { return film_.wet(); }
  std::span<const BloodDrop> drops() const { return drops_.drops(); }
  std::size_t wounds() const { return wounds_.size(); }
  WoundState wound(WoundId id) const;
  BloodLedger ledger() const;
  const Circulation& circulation() const { return circulation_; }
  const SurfaceFilm& film() const { return film_; }
  const VesselFlow& vessels() const { return vessels_; }

 private:
  struct CutVessel {
    VesselSize size;
    double lumen = 1;  ///< share of its area that is open
    double flow = 0;   ///< m3/s
  };
  struct Wound {
    std::vector<std::int32_t> vertices;
    std::vector<double> weights;  ///< sum 1
    Vec3 rest_T = Vec3::Zero(), place_T = Vec3::Zero();
    double area = 0, depth = 0, oozing = 0;
    std::vector<CutVessel> vessels;
    std::vector<bool> met;  ///< sizes that it has met
    std::int32_t end = -1;  ///< of the network
    double end_at = 0, end_sealed = 0;
    double pressed_pa = 0, pressed_share = 0;
    bool was_pressed = false;
    double flow = 0, mean_flow = 0;  ///< m3/s
    double lost = 0, waiting = 0;    ///< m3; of the next drop
  };
  struct Jet {
    double flow = 0, speed = 0;
  };
  std::optional<Wound> wound_at(std::span<const std::int32_t> vertices, std::span<const double> weights) const;
  std::optional<Wound> wound_at(const MaterialPoint& place) const;
  WoundId add(Wound wound, double area_m2, double depth_m);
  void widen(Wound& wound, const Wound& by) const;
  void meet_vessels(Wound& wound) const;
  void coagulate(Wound& wound, double ooze_share, double vessel_share);
  double radius(const Wound& wound) const;
  void solve_network(const BloodPressures& pressures);
  double ooze(const Wound& wound, const BloodPressures& pressures) const;
  Jet vessel_jet(const Wound& wound, const CutVessel& vessel, const BloodPressures& pressures) const;
  void bleed(Wound& wound, const BloodPressures& pressures, std::span<const Vec3> vertices_T, double step_s);
  void spurt(Wound& wound, double volume_m3, double speed, std::span<const Vec3> vertices_T);
  void run(const Wound& wound, double volume_m3);
  void clot(Wound& wound, double step_s) const;

  BleedingOptions options_;
  TriangleSurface rest_;
  Circulation circulation_;
  SurfaceFilm film_;
  BloodDrops drops_;
  VesselFlow whole_vessels_, vessels_;
  bool known_vessels_ = false;
  std::vector<Wound> wounds_;
  std::vector<Irrigation> jets_;
  std::vector<Suction> suctions_;
  double lost_ = 0;             ///< m3
  std::uint64_t launched_ = 0;  ///< drops so far
};

}  // namespace trocar
