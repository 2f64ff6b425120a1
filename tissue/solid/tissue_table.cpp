#include "tissue/solid/tissue_table.h"

#include <limits>
#include <stdexcept>

#include "haptics/input_error.h"
#include "tissue/organ/material_names.h"
#include "tissue/organ/organ_manifest.h"
#include "tissue/organ/toml_table.h"

namespace trocar {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::min();  ///< least value of what must be above zero

/// A key of the file: its unit and what its whole range must lie in.
struct Quantity {
  const char *key, *unit;
  double least, most;
};

double read_quantity(TomlTable& tissue, const Quantity& quantity, TissueSolid& solid) {
  TomlTable entry = tissue.table(quantity.key);
  SourcedValue read;
  read.value = entry.number("value");
  entry.expect("unit", quantity.unit);
  const std::vector<double> range = entry.numbers("range");
  if (range.size() != 2 || !(range[0] <= range[1])) entry.refuse("range", "range holds low and high");
  read.low = range[0], read.high = range[1];
  if (read.low < quantity.least || read.high > quantity.most)
    entry.refuse("range", std::string("range reaches beyond what ") + quantity.key + " can be");
  if (read.value < read.low || read.value > read.high) entry.refuse("value", "value lies outside its own range");
  read.source = entry.text("source");
  read.checked = entry.boolean("checked");
  entry.finish();
  const double value = read.value;
  solid.sources.emplace(quantity.key, std::move(read));
  return value;
}

/// A branch that the file leaves out takes no share.
PronyBranch read_branch(TomlTable& tissue, const Quantity& share, const Quantity& tau, TissueSolid& solid) {
  if (!tissue.has(share.key) && !tissue.has(tau.key)) return {};
  const double value = read_quantity(tissue, share, solid);
  return {value, read_quantity(tissue, tau, solid)};
}

TissueSolid read_tissue(TomlTable& table) {
  TissueSolid solid;
  solid.name = table.text("name");
  solid.aliases = table.texts("aliases");
  const auto read = [&](const char* key, const char* unit, double least, double most) {
    return read_quantity(table, {key, unit, least, most}, solid);
  };
  solid.young_pa = read("young_pa", "Pa", kTiny, kNoEnd);
  solid.poisson = read("poisson", "1", 0, 0.495);
  solid.density_kg_m3 = read("density_kg_m3", "kg/m3", kTiny, kNoEnd);
  solid.prony = {read_branch(table, {"share_1", "1", 0, 1}, {"tau_1_s", "s", kTiny, kNoEnd}, solid),
                 read_branch(table, {"share_2", "1", 0, 1}, {"tau_2_s", "s", kTiny, kNoEnd}, solid)};
  if (solid.prony[0].share + solid.prony[1].share >= 1)
    table.refuse("share_1", "the shares add up to 1 or more: nothing would be left after relaxation");
  solid.stiffening = read("stiffening", "1", 0, kNoEnd);
  solid.residual_strain = read("residual_strain", "1", 0, 0.5);
  solid.rupture_n_per_m = read("rupture_n_per_m", "N/m", kTiny, kNoEnd);
  solid.toughness_j_per_m2 = read("toughness_j_per_m2", "J/m2", kTiny, kNoEnd);
  solid.mu_static = read("mu_static", "1", 0, kNoEnd);
  solid.mu_dynamic = read("mu_dynamic", "1", 0, kNoEnd);
  if (solid.mu_dynamic > solid.mu_static) table.refuse("mu_dynamic", "mu_dynamic must lie in 0..mu_static");
  table.finish();
  return solid;
}

}  // namespace

TissueTable TissueTable::load(const std::filesystem::path& file) { return parse(read_bytes(file), file.string()); }

TissueTable TissueTable::parse(const std::string& text, const std::string& file) {
  TomlTable root = TomlTable::parse(text, file);
  TissueTable table;
  for (TomlTable& entry : root.tables("tissue")) {
    TissueSolid solid = read_tissue(entry);
    for (const TissueSolid& other : table.tissues_)
      if (other.name == solid.name) entry.refuse("name", "two tissues are named \"" + solid.name + "\"");
    table.tissues_.push_back(std::move(solid));
  }
  root.finish();
  if (material_named(table.tissues_, kFallbackMaterial) == nullptr)
    root.refuse("tissue", std::string("no tissue is named \"") + kFallbackMaterial + "\"");
  return table;
}

const TissueSolid& TissueTable::find(const std::string& name) const {
  const TissueSolid* solid = material_named(tissues_, name);
  return solid ? *solid : *material_named(tissues_, kFallbackMaterial);
}

bool TissueTable::knows(const std::string& name) const { return material_named(tissues_, name) != nullptr; }

TissueSolid stiffness_choice(const TissueSolid& tissue, std::string_view choice) {
  TissueSolid chosen = tissue;
  const SourcedValue& young = tissue.sources.at("young_pa");
  if (choice == "soft")
    chosen.young_pa = young.low;
  else if (choice == "stiff")
    chosen.young_pa = young.high;
  else if (choice == "normal")
    chosen.young_pa = young.value;
  else
    throw std::invalid_argument("stiffness is soft, normal or stiff, not \"" + std::string(choice) + "\"");
  return chosen;
}

}  // namespace trocar
