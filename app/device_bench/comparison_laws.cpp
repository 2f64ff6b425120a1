#include "app/device_bench/comparison_laws.h"

#include <algorithm>
#include <cmath>

namespace trocar {
namespace {

constexpr double kViscous = 0.3, kMass = 0.127;  // N s/m, kg at the tip [assumed, reference 3.4]
constexpr double kVelocityLag = 4e-3;            // s
constexpr double kDampingShare = 0.25;           // c of alpha_max = c m / (Td + T/2 + lag)
constexpr double kDeadBand = 0.005;              // m/s
constexpr double kDampingRate = 250;             // N/s
constexpr double kDebtDecay = 0.2;               // s, in free air

struct ThesisLaw {
  double period_s, w = 0;
  double operator()(const ContactWork& work) {
    if (work.wanted_n <= 0) return 0;
    w += work.wanted_n * work.dx_m;
    const double v = work.dx_m / period_s;
    if (w >= 0 || v == 0) return work.wanted_n;
    const double alpha = -w / (period_s * v * v);
    w = 0;
    return std::max(0.0, work.wanted_n + alpha * v);
  }
};

struct ReferenceLaw {
  PassivityParameters seam;
  double budget_j = 0, stored_j = 0, damping_n = 0;
  double operator()(const ContactWork& work) {
    budget_j += work.absorbed_j - (work.stored_j - stored_j);
    stored_j = work.stored_j;
    if (work.wanted_n <= 0) {
      budget_j *= 1 - seam.period_s / kDebtDecay;
      return damping_n = 0;
    }
    const double v = work.speed_m_s, step = kDampingRate * seam.period_s;
    double wanted = 0;
    if (budget_j < 0 && std::abs(v) > kDeadBand) {
      const double most = kDampingShare * kMass / (seam.delay_s + seam.period_s / 2 + kVelocityLag);
      wanted = std::min(most, -budget_j / (seam.period_s * v * v)) * v;
    }
    damping_n = std::clamp(wanted, damping_n - step, damping_n + step);
    if (damping_n * v < 0) damping_n = 0;  // it never outlasts the motion that it damps
    return std::max(0.0, work.wanted_n + damping_n);
  }
};

struct CapLaw {
  double most;  ///< N/m
  double operator()(const ContactWork& work) const {
    return work.wanted_n * (work.stiffness > most ? most / work.stiffness : 1);
  }
};

}  // namespace

std::function<double(const ContactWork&)> comparison_law(ComparisonLaw law, const PassivityParameters& seam) {
  switch (law) {
    case ComparisonLaw::kThesis:
      return ThesisLaw{seam.period_s};
    case ComparisonLaw::kReference:
      return ReferenceLaw{seam};
    case ComparisonLaw::kCap:
      return CapLaw{kViscous / (seam.period_s / 2 + seam.delay_s)};
  }
  return {};
}

}  // namespace trocar
