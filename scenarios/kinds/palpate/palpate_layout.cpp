#include "scenarios/kinds/palpate/palpate_layout.h"

#include <cmath>

#include "scenarios/kinds/palpate/palpate_rules.h"
#include "scenarios/kinds/touch/disc_layout.h"

namespace trocar {

Board lay_out_nodules(const TriangleSurface& organ_T, const Exercise& exercise, const ExerciseLevel& level, int board,
                      const ShaftRoom* room) {
  const PalpateRules& rules = own_rules<PalpateRules>(exercise);
  const PalpateLevel& asked = own_rules<PalpateLevel>(level);
  Exercise places = exercise;
  places.layout.count += asked.decoys;
  Board result = lay_out_discs(organ_T, places, level, board, room);
  for (std::size_t i = 0; i < result.targets.size(); ++i) {
    const bool decoy = i >= rules.nodules.size();
    const NodulePlan& plan = decoy ? rules.nodules.back() : rules.nodules[i];
    const Target& place = result.targets[i];
    result.nodules.push_back({place.centre_T - (plan.top_m + plan.radius_m) * place.normal_T, plan.radius_m,
                              decoy ? asked.decoy_ratio : asked.ratio});
  }
  result.targets.clear();
  return result;
}

double off_along_surface(const Vec3& place_T, const HiddenNodule& nodule, double top_m) {
  const double depth = top_m + nodule.radius_m;
  return std::sqrt(std::max(0.0, (place_T - nodule.centre_T).squaredNorm() - depth * depth));
}

}  // namespace trocar
