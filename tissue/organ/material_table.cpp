#include "tissue/organ/material_table.h"

#include <algorithm>

#include "haptics/input_error.h"
#include "tissue/organ/material_names.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/toml_table.h"

namespace trocar {
namespace {

constexpr double kSoftest = 0.25,
                 kStiffest = 2.0;  ///< of the subject's stiffness: what the device renders calmly beside it

TissueMaterial read_material(TomlTable& table) {
  TissueMaterial material;
  material.name = table.text("name");
  material.aliases = table.texts("aliases");
  material.stiffness_n_per_m = table.number("stiffness_n_per_m");
  const std::vector<double> range = table.numbers("range_n_per_m");
  if (range.size() != 2 || !(range[0] > 0) || range[0] > range[1])
    table.refuse("range_n_per_m", "range_n_per_m holds low and high");
  material.low_n_per_m = range[0], material.high_n_per_m = range[1];
  if (material.stiffness_n_per_m < range[0] || material.stiffness_n_per_m > range[1])
    table.refuse("stiffness_n_per_m", "stiffness_n_per_m lies outside its own range");
  material.mu_static = table.number("mu_static");
  material.mu_dynamic = table.number("mu_dynamic");
  if (material.mu_dynamic < 0 || material.mu_dynamic > material.mu_static)
    table.refuse("mu_dynamic", "mu_dynamic must lie in 0..mu_static");
  material.source = table.text("source");
  material.checked = table.boolean("checked");
  table.finish();
  return material;
}

}  // namespace

MaterialTable MaterialTable::load(const std::filesystem::path& file) { return parse(read_bytes(file), file.string()); }

MaterialTable MaterialTable::parse(const std::string& text, const std::string& file) {
  TomlTable root = TomlTable::parse(text, file);
  MaterialTable table;
  for (TomlTable& entry : root.tables("material")) {
    TissueMaterial material = read_material(entry);
    for (const TissueMaterial& other : table.materials_)
      if (other.name == material.name) root.refuse("material", "two materials are named \"" + material.name + "\"");
    table.materials_.push_back(std::move(material));
  }
  root.finish();
  if (material_named(table.materials_, kFallbackMaterial) == nullptr)
    root.refuse("material", std::string("no material is named \"") + kFallbackMaterial + "\"");
  return table;
}

const TissueMaterial& MaterialTable::find(const std::string& name) const {
  const TissueMaterial* material = material_named(materials_, name);
  return material ? *material : *material_named(materials_, kFallbackMaterial);
}

bool MaterialTable::knows(const std::string& name) const { return material_named(materials_, name) != nullptr; }

ContactMaterial MaterialTable::beside(const ContactMaterial& subject, const std::string& subject_material,
                                      const std::string& adjacent) const {
  const TissueMaterial& mine = find(subject_material);
  const TissueMaterial& other = find(adjacent);
  ContactMaterial result = subject;
  const double ratio = other.stiffness_n_per_m / mine.stiffness_n_per_m;
  result.stiffness_n_per_m = subject.stiffness_n_per_m * std::clamp(ratio, kSoftest, kStiffest);
  if (subject.mu_static > 0) {
    result.mu_static = other.mu_static;
    result.mu_dynamic = other.mu_dynamic;
  }
  return result;
}

}  // namespace trocar
