// Materials by name: what an organ of a given name feels like when it is touched and not the subject of an exercise.
//
// From assets/materials.toml: per material the stiffness of a local contact, its friction, the range seen in the
// literature, the source and whether that source was checked. Values of rigid organs; deforming tissue has its own
// data. SI units. Thread: loading only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/exchange/contact_patch.h"

namespace trocar {

struct TissueMaterial {
  std::string name;                  ///< "liver"
  std::vector<std::string> aliases;  ///< of organs made of it: "kidney_left"; a trailing * stands for any ending
  double stiffness_n_per_m = 0;      ///< of a local contact with a shaft of 5 mm
  double low_n_per_m = 0, high_n_per_m = 0;  ///< range in the literature
  double mu_static = 0, mu_dynamic = 0;
  std::string source;
  bool checked = false;  ///< the source was read; otherwise the value is from memory or derived
};

class MaterialTable {
 public:
  /// @throws InputError with line and column: missing keys, a value outside its range, two materials of one name
  static MaterialTable load(const std::filesystem::path& file);
  static MaterialTable parse(const std::string& text, const std::string& file);

  /// By the material's own name, by an alias, else "soft_tissue".
  const TissueMaterial& find(const std::string& name) const;
  bool knows(const std::string& name) const;
  const std::vector<TissueMaterial>& all() const { return materials_; }

  /// How an adjacent organ feels beside a subject whose surface an exercise has set: stiffer or softer by the ratio of
  /// their materials, within a quarter and twice the subject's.
  ContactMaterial beside(const ContactMaterial& subject, const std::string& subject_material,
                         const std::string& adjacent) const;

 private:
  std::vector<TissueMaterial> materials_;
};

}  // namespace trocar
