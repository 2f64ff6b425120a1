#include "tissue/interaction/vessel_flow.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tissue/mesh/surface/vessel_graph.h"

namespace trocar {
namespace {

constexpr int kMostIterates = 40;
constexpr double kSettled = 1e-11;      // of the largest flow
constexpr double kShortestStub = 1e-4;  // m of a cut vessel: none is without resistance
constexpr double kFloating = 1e-13;  // of the largest conductance: pieces without a supply take the outside's pressure
constexpr double kFull = 1 - 1e-9;   // share from which a closure is shut

double supplied_pressure(Supply supply, const BloodPressures& pressures) {
  switch (supply) {
    case Supply::kArterial:
      return pressures.arterial_pa;
    case Supply::kPortal:
      return pressures.portal_pa;
    case Supply::kVenous:
      return pressures.venous_pa;
    case Supply::kNone:
      break;
  }
  return pressures.outside_pa;
}

}  // namespace

double poiseuille_resistance(double viscosity_pa_s, double radius_m, double length_m) {
  return 8 * viscosity_pa_s * length_m / (std::numbers::pi * std::pow(radius_m, 4));
}

double jet_loss(double exit_loss, double density_kg_per_m3, double radius_m) {
  const double area = std::numbers::pi * radius_m * radius_m;
  return exit_loss * density_kg_per_m3 / (2 * area * area);
}

double jet_flow(double pressure_pa, double resistance, double exit_pa_s2_per_m6) {
  if (!(pressure_pa > 0)) return 0;
  // The root of c Q^2 + R Q - p that does not cancel.
  return 2 * pressure_pa / (resistance + std::sqrt(resistance * resistance + 4 * exit_pa_s2_per_m6 * pressure_pa));
}

std::int32_t VesselFlow::add_node(const FlowNode& node) {
  nodes_.push_back(node);
  pressure_.push_back(0);
  return static_cast<std::int32_t>(nodes_.size()) - 1;
}

std::int32_t VesselFlow::add_vessel(const Vessel& vessel) {
  const auto count = static_cast<std::int32_t>(nodes_.size());
  if (vessel.from < 0 || vessel.to < 0 || vessel.from >= count || vessel.to >= count || vessel.from == vessel.to)
    throw std::invalid_argument("a vessel between nodes that are not there");
  if (!(vessel.radius_m > 0) || !(vessel.length_m > 0))
    throw std::invalid_argument("a vessel without radius or length");
  vessels_.emplace_back().vessel = vessel;
  return static_cast<std::int32_t>(vessels_.size()) - 1;
}

void VesselFlow::cut(std::int32_t vessel, double at) {
  State& state = vessels_[static_cast<std::size_t>(vessel)];
  if (!state.is_cut()) {
    ends_.push_back({.vessel = vessel, .at_from = true});
    ends_.push_back({.vessel = vessel, .at_from = false});
    state.flow = {};
  }
  const double place = std::clamp(at, 0.0, 1.0);
  state.cut_low = std::min(state.cut_low, place);
  state.cut_high = std::max(state.cut_high, place);
}

void VesselFlow::close(std::int32_t vessel, const Closure& closure) {
  auto& closures = vessels_[static_cast<std::size_t>(vessel)].closures;
  const auto same = std::ranges::find_if(closures, [&](const Closure& old) { return old.at == closure.at; });
  if (same == closures.end())
    closures.push_back(closure);
  else if (closure.share > same->share)
    *same = closure;
}

void VesselFlow::clip(std::int32_t vessel, double at, double share) {
  close(vessel, {std::clamp(at, 0.0, 1.0), std::clamp(share, 0.0, 1.0), options_.clip_holds_pa});
}

void VesselFlow::unclip(std::int32_t vessel, double at) {
  std::erase_if(vessels_[static_cast<std::size_t>(vessel)].closures,
                [place = std::clamp(at, 0.0, 1.0)](const Closure& closure) { return closure.at == place; });
}

void VesselFlow::seal(std::int32_t vessel, double at, double share) {
  close(vessel, {std::clamp(at, 0.0, 1.0), std::clamp(share, 0.0, 1.0), options_.seal_holds_pa});
}

void VesselFlow::pinch(std::int32_t vessel, double at, double share) {
  vessels_[static_cast<std::size_t>(vessel)].pinched = {std::clamp(at, 0.0, 1.0), std::clamp(share, 0.0, 1.0),
                                                        options_.pinch_holds_pa};
}

void VesselFlow::press(std::int32_t vessel, double pressure_pa) {
  vessels_[static_cast<std::size_t>(vessel)].pressed_pa = std::max(0.0, pressure_pa);
}

VesselFlow::Element VesselFlow::piece(State& state, double low, double high) const {
  const double radius = state.vessel.radius_m;
  const double length = std::max((high - low) * state.vessel.length_m, kShortestStub);
  Element out;
  out.resistance = poiseuille_resistance(options_.viscosity_pa_s, radius, length);
  out.pressed_pa = state.pressed_pa;
  const auto narrow = [&](const Closure& closure) {
    if (closure.at < low || closure.at > high) return;
    const bool shut = closure.share >= kFull;
    const double left = 1 - (shut ? options_.leak_share : closure.share);
    out.resistance += poiseuille_resistance(options_.viscosity_pa_s, radius, options_.closure_m) / (left * left);
    if (shut) out.holds_pa += closure.holds_pa;
  };
  for (const Closure& closure : state.closures) narrow(closure);
  if (state.pinched.share > 0) narrow(state.pinched);
  return out;
}

std::vector<VesselFlow::Element> VesselFlow::elements() {
  std::vector<Element> out;
  for (State& state : vessels_) {
    const auto add = [&](double low, double high, std::int32_t a, std::int32_t b, double& flow) {
      Element element = piece(state, low, high);
      element.a = a;
      element.b = b;
      if (b < 0)
        element.jet = jet_loss(options_.exit_loss, options_.density_kg_per_m3, options_.spasm * state.vessel.radius_m);
      element.flow = flow;
      element.result = &flow;
      out.push_back(element);
    };
    if (state.is_cut()) {
      add(0, state.cut_low, state.vessel.from, -1, state.flow[0]);
      add(state.cut_high, 1, state.vessel.to, -1, state.flow[1]);
    } else {
      add(0, 1, state.vessel.from, state.vessel.to, state.flow[0]);
    }
  }
  return out;
}

void VesselFlow::linearise(Element& e, double outside_pa) const {
  const double p_a = pressure_[static_cast<std::size_t>(e.a)];
  const double p_b = e.b < 0 ? outside_pa : pressure_[static_cast<std::size_t>(e.b)];
  const double sign = p_a >= p_b ? 1 : -1, front = std::max(p_a, p_b), behind = std::min(p_a, p_b);
  const double pressed = e.pressed_pa > 0 ? outside_pa + e.pressed_pa : behind;
  const double lost = std::max(0.0, pressed - behind) + e.holds_pa;
  const bool obstructed = lost > 0 && front - behind <= lost;
  if (obstructed || (e.b < 0 && p_a < p_b)) {
    e.conductance = e.offset = 0;
    return;
  }
  e.conductance = 1 / (e.resistance + 2 * e.jet * std::abs(e.flow));
  e.offset = sign * lost - e.jet * e.flow * std::abs(e.flow);
}

void VesselFlow::solve_pressures(const std::vector<Element>& elements, const BloodPressures& pressures) {
  std::vector<std::int32_t> unknown(nodes_.size(), -1);
  std::int32_t count = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].supply == Supply::kNone)
      unknown[n] = count++;
    else
      pressure_[n] = supplied_pressure(nodes_[n].supply, pressures);
  }
  if (count == 0) return;
  double largest = 1e-30;
  for (const Element& e : elements) largest = std::max(largest, e.conductance);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::int32_t i = unknown[n];
    if (i < 0) continue;
    const double bed = nodes_[n].capillary_m3_per_pa_s, floating = kFloating * largest;
    entries.emplace_back(i, i, bed + floating);
    right[i] += bed * pressures.venous_pa + floating * pressures.outside_pa;
  }
  const auto add_side = [&](const Element& e, std::int32_t here, std::int32_t there, double sign) {
    const std::int32_t i = unknown[static_cast<std::size_t>(here)];
    if (i < 0) return;
    entries.emplace_back(i, i, e.conductance);
    right[i] += sign * e.conductance * e.offset;
    const std::int32_t j = there < 0 ? -1 : unknown[static_cast<std::size_t>(there)];
    if (j >= 0)
      entries.emplace_back(i, j, -e.conductance);
    else
      right[i] += e.conductance * (there < 0 ? pressures.outside_pa : pressure_[static_cast<std::size_t>(there)]);
  };
  for (const Element& e : elements) {
    add_side(e, e.a, e.b, 1);
    if (e.b >= 0) add_side(e, e.b, e.a, -1);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::VectorXd solved = solver.solve(right);
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (unknown[n] >= 0) pressure_[n] = solved[unknown[n]];
}

void VesselFlow::solve(const BloodPressures& pressures) {
  std::vector<Element> all = elements();
  // What is shut by pressure opens only once the pressure in front of it is known: the first iterate has all open.
  for (Element& e : all) e.conductance = 1 / (e.resistance + 2 * e.jet * std::abs(e.flow)), e.offset = 0;
  solve_pressures(all, pressures);
  for (int iterate = 0; iterate < kMostIterates; ++iterate) {
    for (Element& e : all) linearise(e, pressures.outside_pa);
    solve_pressures(all, pressures);
    double largest = 0, change = 0;
    for (Element& e : all) {
      const double p_b = e.b < 0 ? pressures.outside_pa : pressure_[static_cast<std::size_t>(e.b)];
      const double flow = e.conductance * (pressure_[static_cast<std::size_t>(e.a)] - p_b - e.offset);
      change = std::max(change, std::abs(flow - e.flow));
      largest = std::max(largest, std::abs(flow));
      e.flow = flow;
    }
    if (iterate > 0 && change <= kSettled * largest) break;
  }
  for (const Element& e : all) *e.result = e.b < 0 ? std::max(0.0, e.flow) : e.flow;
  report_ends();
}

void VesselFlow::report_ends() {
  for (OpenEnd& end : ends_) {
    const State& state = vessels_[static_cast<std::size_t>(end.vessel)];
    const double radius = options_.spasm * state.vessel.radius_m;
    end.flow_m3_per_s = state.flow[end.at_from ? 0 : 1];
    end.speed_m_per_s = end.flow_m3_per_s / (std::numbers::pi * radius * radius);
  }
}

VesselFlow vessel_flow(const VesselGraph& graph, const TreeSupply& supply, const VesselFlowOptions& options) {
  constexpr double kShortest = 1e-5, kThinnest = 5e-5;  // m
  std::vector<int> in(graph.nodes.size()), out(graph.nodes.size());
  for (const auto& [from, to] : graph.edges) {
    ++out[static_cast<std::size_t>(from)];
    ++in[static_cast<std::size_t>(to)];
  }
  VesselFlow network(options);
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    if (in[n] == 0 && out[n] > 0)
      network.add_node({.supply = supply.supply});
    else
      network.add_node({.capillary_m3_per_pa_s = out[n] == 0 ? supply.capillary_m3_per_pa_s : 0});
  }
  for (const auto& [from, to] : graph.edges) {
    const VesselNode &a = graph.nodes[static_cast<std::size_t>(from)], &b = graph.nodes[static_cast<std::size_t>(to)];
    network.add_vessel({from, to, std::max((a.radius_m + b.radius_m) / 2, kThinnest),
                        std::max((b.place_m - a.place_m).norm(), kShortest)});
  }
  return network;
}

}  // namespace trocar
