// Heat of energised instruments in tissue: where it goes, what it does, and every joule of it.
//
//   rho c dT/dt = div(k(T) grad T) - w (1 - Omega) (T - T_body) + q          Pennes 1948; w in W/(m3 K)
//   q           of a contact of radius a: P g(r) / sum of g, g = 1 / (1 + (r/a)^2)^2, the current's spread into a
//               half-space (far away r^-4), nothing beyond a + min(3 a, 6 mm); of a cut, whose sparks go to what is
//               nearest, a in g is 0.3 mm
//   boiling     at 100 C the excess turns water into steam; a cube without water heats on and chars, or, under a cut,
//               is vaporised: tissue no more, heat and steam gone with it
//   damage      dOmega/dt = A exp(-Ea / R T), cells and collagen each; cells are white at 1, blood no longer flows
//   char        of dry tissue above 150 C, faster the hotter; what vaporises leaves some on its walls
//   tip         the instrument's tip stores heat: a share of the power, and what its contact exchanges (4 k a, disc on
//               a half-space)
//
// On cubes of 1 mm of the organ at rest (heat_grid.h), explicit. A step is divided so that no cube gives away more
// than it has above its surroundings: temperatures stay within those of their neighbours, sources stop at their cap, so
// no temperature ever exceeds it. Surfaces lose to the gas; else they are insulated, and so is the edge of the blocks
// that exist: these grow as soon as 0.1 K arrive, sleep when cooled, and are freed when nothing happened in them.
// When nothing is heated four steps are taken as one, ten when all is cooler than 43 C.
//
// Temperatures in deg C, differences in K. Frame T at rest, SI. Thread: tissue task. Same input, same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "haptics/exchange/material_point.h"
#include "tissue/interaction/arrhenius.h"
#include "tissue/interaction/heat_grid.h"
#include "tissue/interaction/heat_looks.h"
#include "tissue/mesh/surface/surface_growth.h"
#include "tissue/surface_snapshot.h"

namespace trocar {

/// [M] from memory, not verified; [C] a choice. Liver.
struct TissueHeatOptions {
  double step_s = 0.01;
  double edge_m = 0.001;  ///< of a cube

  double body_c = 37;
  double density_kg_m3 = 1060;             ///< [M]
  double specific_heat_j_per_kg_k = 3540;  ///< of wet tissue, [M] 3370 to 3700
  double conductivity_w_per_m_k = 0.52;    ///< at body_c, [M] 0.48 to 0.57
  double conductivity_slope = 0.00116;     ///< W/(m K) per K up to boil_c, [M] 0.001 to 0.003
  double dry_conductivity_share = 0.35;    ///< of that when the water is gone, [C]
  double perfusion_w_per_m3_k = 58000;     ///< w_b rho_b c_b, [M] 15 ml/s per litre of liver, blood 3.8 MJ/(m3 K)
  double gas_w_per_m2_k = 15;              ///< [C] still or insufflated gas 5 to 25; faces of cubes, relative to body_c

  double boil_c = 100;
  double water_kg_m3 = 740;        ///< [M] 70 % of the mass
  double water_j_per_kg_k = 4186;  ///< heat that leaves with it
  double latent_j_per_kg = 2.257e6;

  ArrheniusLaw cells{7.39e39, 257.7e3};         ///< [M] cells of liver and skin
  ArrheniusLaw collagen{1.606e45, 306e3};       ///< [M] rat skin
  double damage_from_c = 43;                    ///< below it nothing is destroyed: the law alone would kill at 37 C
  double char_from_c = 150, char_full_c = 200;  ///< [C]
  double char_s = 0.3;                          ///< at char_full_c until all is char, [C]
  double char_dry = 0.05;                       ///< water left below which it chars, [C]
  double char_left_by_cut = 0.4;                ///< share on the walls of what a cut vaporised, [C]

  double soft_cap_c = 98;   ///< soft coagulation: regulated to stay below boiling
  double hard_cap_c = 350;  ///< nothing gets hotter, [C]

  double tip_j_per_k = 0.1;       ///< 0.2 g of steel, [C]
  double tip_cools_s = 8;         ///< along the shaft, [C]
  double tip_power_share = 0.05;  ///< of sparks (cut, forced coagulation), [C]

  double most_radius_m = 0.010;    ///< of a contact that is counted
  double most_spread_m = 0.006;    ///< of the current beyond the contact
  double spark_radius_m = 0.0003;  ///< a of a cut, whose sparks go to what is nearest, [C]
  int look_every = 4;              ///< steps between two looks of the vertices
};

enum class HeatMode : std::uint8_t {
  kSoftCoagulation,    ///< regulated below boiling: white, no char, no cut
  kForcedCoagulation,  ///< sparks: dries and chars
  kCut,                ///< vaporises
};

/// An instrument that touches the tissue.
struct HeatSource {
  Vec3 rest_T = Vec3::Zero();  ///< middle of the contact
  double radius_m = 0;         ///< of the contact: sqrt(area / pi); 0: it touches nothing
  double power_w = 0;          ///< 0: only its tip is warm
  HeatMode mode = HeatMode::kSoftCoagulation;
  int tool = 0;  ///< whose tip
};

/// What became of a source in a step.
struct HeatGiven {
  bool touches = false;    ///< power or a warm tip, and tissue is there
  double offered_j = 0;    ///< power times step
  double delivered_j = 0;  ///< to tissue and tip: less without contact and at the cap
  double contact_c = 0;    ///< mean of the tissue under the contact
};

/// A cube that is tissue no more.
struct VaporisedCube {
  Vec3 middle_T = Vec3::Zero();  ///< at rest
  double edge_m = 0;
};

/// Since the beginning or the last reset(), J: delivered + from_tip = stored + steam + perfused + to_gas + removed +
/// dropped.
struct HeatLedger {
  double offered_j = 0;    ///< power of all sources times time
  double delivered_j = 0;  ///< of that into tissue
  double from_tip_j = 0;   ///< from hot tips, less what tips took
  double into_tip_j = 0;   ///< of offered: sparks at the tip
  double stored_j = 0;     ///< in tissue above the body's temperature, now
  double steam_j = 0;      ///< latent, and what the water had
  double perfused_j = 0;
  double to_gas_j = 0;
  double removed_j = 0;  ///< with vaporised tissue, or tissue that a new surface leaves out
  double dropped_j = 0;  ///< of blocks that had cooled to 0.05 K
  double missing_j() const {
    return delivered_j + from_tip_j - stored_j - steam_j - perfused_j - to_gas_j - removed_j - dropped_j;
  }
};

class TissueHeat {
 public:
  /// @param rest_T closed, undeformed. @throws InputError when an option is out of range.
  explicit TissueHeat(SurfacePtr rest_T, const TissueHeatOptions& options = {});

  /// One step of options.step_s. @param sources that touch the tissue now; each in its place at rest
  void step(std::span<const HeatSource> sources);
  /// The surface has changed. @param rest_T as it is now. @param added its new vertices, after the old ones
  void grow(SurfacePtr rest_T, const std::vector<VertexOrigin>& added);
  /// As new: cold and unhurt. The surface stays.
  void reset();

  const std::vector<HeatGiven>& given() const { return given_; }              ///< by source of the last step
  const std::vector<VaporisedCube>& vaporised() const { return vaporised_; }  ///< in the last step
  const std::vector<float>& white() const { return looks_.white(); }          ///< share by vertex
  const std::vector<float>& charred() const { return looks_.charred(); }
  std::uint64_t looks() const { return looks_.number(); }  ///< changes whenever white() or charred() may have

  Vec3 at_rest(const MaterialPoint& place) const;  ///< of the surface
  // Of a place at rest, between the cubes' middles; body_c and 0 where nothing has been heated or nothing is tissue.
  double temperature_at(const Vec3& rest_T) const;
  double damage_at(const Vec3& rest_T) const;    ///< Omega of cells
  double softened_at(const Vec3& rest_T) const;  ///< share of the collagen that is denatured
  HeatLook look_at(const Vec3& rest_T) const;    ///< finer than the vertices'
  bool vaporised_at(const Vec3& rest_T) const;   ///< its cube is tissue no more
  /// Omega >= 1 over the whole section. @param axis along the vessel, any length. @param radius_m outer
  bool sealed_at(const Vec3& rest_T, const Vec3& axis, double radius_m) const;
  double tip_c(int tool) const;

  HeatLedger ledger() const;
  double hottest_c() const;  ///< of all tissue
  bool cold() const { return awake_.empty(); }
  std::size_t awake_blocks() const { return awake_.size(); }
  std::size_t blocks() const { return grid_.blocks(); }
  double most_stable_step_s() const;  ///< longer steps are divided

 private:
  /// The cubes that a source heats, by place.
  struct Spread {
    std::vector<HeatCube> cube;
    std::vector<double> share;  ///< of the power, sum 1
    std::vector<bool> under;    ///< the contact itself
  };
  void check_options() const;
  double capacity(double water) const;  ///< of a cube with this share of water, J/K
  double latent_j() const;              ///< of all water of a cube
  double room_j(const HeatBlock& block, std::size_t cell, HeatMode mode) const;
  void set_conductivity(HeatBlock& block);
  HeatBlock* wake(const HeatBlock::Index& index);
  void examine_again(HeatBlock& block);
  bool heats(const HeatSource& source) const;
  Spread spread_of(const HeatSource& source);
  double contact_rise(const Spread& spread) const;
  void heat(const HeatSource& source, double dt, HeatGiven& given);
  void deliver(const HeatSource& source, const Spread& spread, double dt, HeatGiven& given);
  void exchange_with_tip(const HeatSource& source, const Spread& spread, double dt);
  void cool_tips(double dt);
  double& tip(int tool);
  void advance(std::span<const HeatSource> sources, double seconds);
  void conduct_all(double dt);
  void settle(HeatBlock& block, double dt);
  void settle(HeatBlock& block, std::size_t cell, double mean_k, double dt);
  void boil(HeatBlock& block, std::size_t cell);
  void hurt(HeatBlock& block, std::size_t cell, double temperature_c, double dt);
  void vaporise(HeatBlock& block, std::size_t cell);
  void spread_and_sleep();
  bool unhurt(const HeatBlock& block) const;

  TissueHeatOptions options_;
  HeatGrid grid_;
  HeatLooks looks_;
  ArrheniusTable cell_rate_, collagen_rate_;
  std::vector<HeatBlock*> awake_;  ///< by index
  std::vector<HeatGiven> given_;
  std::vector<VaporisedCube> vaporised_;
  std::vector<double> tips_;  ///< rise by tool, K
  HeatLedger ledger_;
  double hottest_k_ = 0;
  double pending_s_ = 0;  ///< of quiet steps not yet taken
  std::int64_t steps_ = 0;
};

}  // namespace trocar
