#include "tissue/organ/material_table.h"

#include <gtest/gtest.h>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::material_table_test {
namespace {

const std::filesystem::path kShipped = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets" / "materials.toml";

std::string entry(const std::string& name, double stiffness, const std::string& aliases = "") {
  return "[[material]]\nname = '" + name + "'\naliases = [" + aliases +
         "]\nstiffness_n_per_m = " + std::to_string(stiffness) +
         "\nrange_n_per_m = [10, 400]\nmu_static = 0.1\nmu_dynamic = 0.05\nsource = 's'\nchecked = true\n";
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { MaterialTable::parse(text, "m.toml"); });
}

TEST(MaterialTable, TheShippedOneKnowsTheOrgansOfTheTables) {
  const MaterialTable table = MaterialTable::load(kShipped);
  for (const auto& [organ, material] :
       {std::pair("liver", "liver"), std::pair("kidney_left", "kidney"), std::pair("aorta", "artery"),
        std::pair("colon", "bowel"), std::pair("inferior_vena_cava", "vein"), std::pair("common_bile_duct", "duct"),
        std::pair("vertebrae_L3", "bone"), std::pair("cystic_artery", "artery"),
        std::pair("something_else", "soft_tissue")})
    EXPECT_EQ(table.find(organ).name, material) << organ;
  EXPECT_FALSE(table.knows("something_else"));
  for (const TissueMaterial& material : table.all()) EXPECT_FALSE(material.source.empty()) << material.name;
}

TEST(MaterialTable, LiverFollowsFromItsModulusByTheFlatPunch) {
  constexpr double kRadius = 2.5e-3, kModulus = 5e3, kPoisson = 0.47;
  const double punch = 2 * kRadius * kModulus / (1 - kPoisson * kPoisson);
  EXPECT_NEAR(MaterialTable::load(kShipped).find("liver").stiffness_n_per_m, punch, 1);
}

TEST(MaterialTable, ANeighbourIsStifferByTheRatioWithinBounds) {
  const MaterialTable table = MaterialTable::parse(
      entry("soft_tissue", 40) + entry("liver", 40) + entry("kidney", 60) + entry("bone", 400) + entry("fat", 10),
      "m.toml");
  const ContactMaterial subject{.stiffness_n_per_m = 100, .damping_s_per_m = 0.5};
  EXPECT_DOUBLE_EQ(table.beside(subject, "liver", "kidney").stiffness_n_per_m, 150);
  EXPECT_DOUBLE_EQ(table.beside(subject, "liver", "bone").stiffness_n_per_m, 200) << "at most twice";
  EXPECT_DOUBLE_EQ(table.beside(subject, "bone", "fat").stiffness_n_per_m, 25) << "at least a quarter";
  EXPECT_DOUBLE_EQ(table.beside(subject, "liver", "kidney").damping_s_per_m, 0.5);
}

TEST(MaterialTable, FrictionStaysOffWhereTheExerciseHasNone) {
  const MaterialTable table = MaterialTable::load(kShipped);
  EXPECT_EQ(table.beside({.mu_static = 0}, "liver", "bowel").mu_static, 0);
  EXPECT_EQ(table.beside({.mu_static = 0.3, .mu_dynamic = 0.2}, "liver", "colon").mu_static, 0.054);
}

TEST(MaterialTable, RefusesWithPlaceAndReason) {
  EXPECT_CONTAINS(refusal(entry("liver", 40)), "no material is named \"soft_tissue\"");
  EXPECT_CONTAINS(refusal(entry("soft_tissue", 4000)), "outside its own range");
  EXPECT_CONTAINS(refusal(entry("soft_tissue", 40) + entry("soft_tissue", 50)), "two materials are named");
  EXPECT_CONTAINS(refusal(entry("soft_tissue", 40) + "colour = 1\n"), "unknown key \"colour\"");
  std::string without_unit = entry("soft_tissue", 40);
  without_unit.replace(without_unit.find("stiffness_n_per_m"), 17, "stiffness");
  EXPECT_CONTAINS(refusal(without_unit), "key \"stiffness_n_per_m\" is missing");
  std::string slippery = entry("soft_tissue", 40);
  slippery.replace(slippery.find("mu_dynamic = 0.05"), 17, "mu_dynamic = 0.50");
  EXPECT_CONTAINS(refusal(slippery), "m.toml:7:14: mu_dynamic must lie in 0..mu_static");
}

}  // namespace
}  // namespace trocar::material_table_test
