// Blood through a network of vessels, whole, cut, clipped, sealed and pressed.
//
//   vessel     Poiseuille: dp = R Q, R = 8 mu L / (pi r^4)
//   closure    a clip or a seal that takes a share s of the lumen's area over a short length: its R over (1 - s)^2; at
//              s = 1 nothing passes below the pressure that it holds, and what is above it leaks
//   press      a collapsible tube (Starling resistor): pressed from outside with p_e, the pressure behind is at least
//              p_e for what comes from in front, and nothing passes once p_e is above both
//   open end   a cut vessel has two. The jet's kinetic energy is lost: dp = R Q + K rho Q^2 / (2 A^2); no gas goes in
//   node       of a given pressure (inlet, outlet), or of no net flow, with a bed of capillaries behind it to the veins
// All elements read Q = G (p_a - p_b - o) with G and o from the last iterate (Newton for the jet); the nodes' pressures
// are one sparse solve per iterate. Pa, m, m3/s. Thread: tissue task. Same input, same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tissue/interaction/circulation.h"

namespace trocar {

struct VesselGraph;

enum class Supply : std::uint8_t { kNone, kArterial, kPortal, kVenous };

struct FlowNode {
  Supply supply = Supply::kNone;     ///< kNone: its pressure is solved for
  double capillary_m3_per_pa_s = 0;  ///< conductance of the bed behind it
};

struct Vessel {
  std::int32_t from = 0, to = 0;
  double radius_m = 0, length_m = 0;
};

/// Of a cut vessel, on the side of its `from` or its `to`.
struct OpenEnd {
  std::int32_t vessel = 0;
  bool at_from = true;
  double flow_m3_per_s = 0;  ///< out of it
  double speed_m_per_s = 0;  ///< of the jet
};

struct VesselFlowOptions {
  double viscosity_pa_s = 3.5e-3;  ///< whole blood at high shear rate, 37 C; unchecked
  double density_kg_per_m3 = 1060;
  double exit_loss = 1.0;              ///< K: 1 for a jet that loses its kinetic energy
  double spasm = 0.6;                  ///< a cut end narrows to this share of its radius; unchecked
  double closure_m = 0.0015;           ///< length of a vessel that a clip presses; unchecked
  double leak_share = 0.9;             ///< of the lumen that a full closure still takes when it leaks
  double clip_holds_pa = 300 * kMmHg;  ///< titanium clips hold it (tissue.md 3)
  double pinch_holds_pa = 20000;       ///< between pads (unchecked)
  double seal_holds_pa = 300 * kMmHg;  ///< of a bipolar seal of a small artery; unchecked
};

/// Resistance of a tube, Pa s/m3.
double poiseuille_resistance(double viscosity_pa_s, double radius_m, double length_m);
/// Flow of a jet from behind a resistance: dp = R Q + c Q^2. @param pressure_pa <= 0: none
double jet_flow(double pressure_pa, double resistance, double exit_pa_s2_per_m6);
/// c of jet_flow().
double jet_loss(double exit_loss, double density_kg_per_m3, double radius_m);

class VesselFlow {
 public:
  explicit VesselFlow(const VesselFlowOptions& options = {}) : options_(options) {}

  std::int32_t add_node(const FlowNode& node);
  /// @throws std::invalid_argument for an end that is no node, or a radius or length that is not positive
  std::int32_t add_vessel(const Vessel& vessel);

  /// @param at 0 at the vessel's `from` .. 1 at its `to`. What lies between two cuts is out of the network.
  void cut(std::int32_t vessel, double at);
  /// @param share of the lumen's area, 0 .. 1
  void clip(std::int32_t vessel, double at, double share);
  /// Takes off what was closed at exactly that place.
  void unclip(std::int32_t vessel, double at);
  void seal(std::int32_t vessel, double at, double share);
  /// Until the next: pressure from outside beside the surroundings', Pa.
  void press(std::int32_t vessel, double pressure_pa);
  /// Until the next: jaws that press it together there. 0: none
  void pinch(std::int32_t vessel, double at, double share);
  void solve(const BloodPressures& pressures);

  std::size_t nodes() const { return nodes_.size(); }
  std::size_t vessels() const { return vessels_.size(); }
  const Vessel& vessel(std::int32_t v) const { return vessels_[static_cast<std::size_t>(v)].vessel; }
  double pressure_pa(std::int32_t node) const { return pressure_[static_cast<std::size_t>(node)]; }
  /// Out of its `from` into it, m3/s.
  double flow_m3_per_s(std::int32_t vessel) const { return vessels_[static_cast<std::size_t>(vessel)].flow[0]; }
  const std::vector<OpenEnd>& open_ends() const { return ends_; }  ///< two of every cut vessel, in order of cutting

 private:
  struct Closure {
    double at = 0, share = 0, holds_pa = 0;
  };
  struct State {
    Vessel vessel;
    std::vector<Closure> closures;
    Closure pinched;
    double cut_low = 2, cut_high = -1;  ///< first and last cut; none: low > high
    double pressed_pa = 0;
    std::array<double, 2> flow{};  ///< into the vessel at `from`, at `to`
    bool is_cut() const { return cut_low <= cut_high; }
  };
  /// Between two nodes, or a node and the outside (b = -1).
  struct Element {
    std::int32_t a = 0, b = -1;
    double resistance = 0, jet = 0, holds_pa = 0, pressed_pa = 0;
    double flow = 0;  ///< of the last iterate
    double conductance = 0, offset = 0;
    double* result = nullptr;
  };
  void close(std::int32_t vessel, const Closure& closure);
  Element piece(State& state, double low, double high) const;
  std::vector<Element> elements();
  void linearise(Element& element, double outside_pa) const;
  void solve_pressures(const std::vector<Element>& elements, const BloodPressures& pressures);
  void report_ends();

  VesselFlowOptions options_;
  std::vector<FlowNode> nodes_;
  std::vector<State> vessels_;
  std::vector<double> pressure_;
  std::vector<OpenEnd> ends_;
};

struct TreeSupply {
  Supply supply = Supply::kArterial;
  double capillary_m3_per_pa_s = 2e-12;  ///< of each end; unchecked
};

/// The network of a tree of centrelines: its node i is the graph's, its vessel k the graph's edge k. Roots (nodes that
/// no edge leads to) are inlets, ends have a bed of capillaries.
VesselFlow vessel_flow(const VesselGraph& graph, const TreeSupply& supply, const VesselFlowOptions& options = {});

}  // namespace trocar
