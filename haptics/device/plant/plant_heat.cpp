#include "haptics/device/plant/plant_heat.h"

namespace trocar {

PlantHeat::PlantHeat(const HeatParameters& parameters, double resistance)
    : p_(parameters), cold_ohm_(resistance), winding_(parameters.start_c), case_(parameters.start_c) {}

double PlantHeat::resistance_at(double winding) const noexcept {
  return cold_ohm_ * (1 + p_.copper_per_k * (winding - p_.ambient_c));
}

PlantHeat::Rates PlantHeat::rates(double winding, double housing, double current) const noexcept {
  const double loss = current * current * resistance_at(winding);  // W
  const double into_case = (winding - housing) / p_.winding_to_case;
  const double into_air = (housing - p_.ambient_c) / p_.case_to_air;
  const double winding_capacity = p_.winding_time / p_.winding_to_case;  // J/K
  const double case_capacity = p_.case_time / p_.case_to_air;
  return {(loss - into_case) / winding_capacity, (into_case - into_air) / case_capacity};
}

void PlantHeat::advance(double current, double dt) noexcept {
  const Rates now = rates(winding_, case_, current);
  const Rates then = rates(winding_ + dt * now.winding, case_ + dt * now.housing, current);
  winding_ += 0.5 * dt * (now.winding + then.winding);
  case_ += 0.5 * dt * (now.housing + then.housing);
}

}  // namespace trocar
