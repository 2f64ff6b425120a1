// What deforming tissue is made of, by name: elasticity, relaxation, strength and friction, with their range and
// source.
//
// From assets/tissues.toml (tissue.md 4.1). Small-strain moduli felt at about 1 s; the literature spreads threefold and
// more, so every number has a range and a source, and an instructor picks soft, normal or stiff. Never a patient's
// truth. SI units. Thread: loading only.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace trocar {

/// One branch of a Prony series: share of the instantaneous stiffness that relaxes, and how fast.
struct PronyBranch {
  double share = 0;  ///< 0 <= share, all shares together < 1
  double tau_s = 0;  ///< > 0 where the share is
};

/// A number of a material and where it is from.
struct SourcedValue {
  double value = 0, low = 0, high = 0;  ///< low <= value <= high, in the unit of its key
  std::string source;
  bool checked = false;  ///< the source was read; otherwise from memory or derived
};

struct TissueSolid {
  std::string name = "liver";
  std::vector<std::string> aliases;  ///< of organs made of it; a trailing * stands for any ending
  double young_pa = 5000;            ///< long-term: of what is left after relaxation
  double poisson = 0.45;             ///< 0 .. 0.495
  double density_kg_m3 = 1060;
  std::array<PronyBranch, 2> prony{};           ///< instantaneous modulus = young / (1 - sum of shares)
  double stiffening = 0;                        ///< c of mu = mu_0 exp(c strain), strain the equivalent (von Mises) one
  double residual_strain = 0;                   ///< tension at rest over the modulus: what opens a wound
  double rupture_n_per_m = 300;                 ///< tension per width at which the surface tears
  double toughness_j_per_m2 = 164;              ///< energy that a cut takes per area
  double mu_static = 0.10, mu_dynamic = 0.05;   ///< of wet serosa on smooth steel
  std::map<std::string, SourcedValue> sources;  ///< by key of the file
};

}  // namespace trocar
