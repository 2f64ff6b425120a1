#include "tissue/solid/tissue_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/organ/material_table.h"

namespace trocar::tissue_table_test {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(TROCAR_SOURCE_DIR) / "assets";

/// One tissue, all keys; line 3 is young_pa.
std::string entry(const std::string& name) {
  const auto number = [](const std::string& key, const std::string& value, const std::string& range,
                         const std::string& unit) {
    return key + " = { value = " + value + ", range = [" + range + "], unit = '" + unit +
           "', source = 's', checked = true }\n";
  };
  return "[[tissue]]\nname = '" + name + "'\n" + number("young_pa", "5000", "2000, 9000", "Pa") + "aliases = []\n" +
         number("poisson", "0.45", "0.45, 0.49", "1") + number("density_kg_m3", "1060", "1000, 1100", "kg/m3") +
         number("share_1", "0.35", "0.2, 0.7", "1") + number("tau_1_s", "0.1", "0.1, 0.2", "s") +
         number("share_2", "0.25", "0.2, 0.7", "1") + number("tau_2_s", "5", "2, 9", "s") +
         number("stiffening", "3", "0, 6", "1") + number("residual_strain", "0.06", "0, 0.2", "1") +
         number("rupture_n_per_m", "300", "50, 600", "N/m") + number("toughness_j_per_m2", "164", "80, 330", "J/m2") +
         number("mu_static", "0.1", "0, 0.2", "1") + number("mu_dynamic", "0.05", "0, 0.2", "1");
}

std::string refusal(const std::string& text) {
  return test::message_of<InputError>([&] { TissueTable::parse(text, "t.toml"); });
}

/// What the loader says of an entry in which one text stands for another.
std::string refusal_with(const std::string& old_text, const std::string& new_text) {
  std::string text = entry("soft_tissue");
  text.replace(text.find(old_text), old_text.size(), new_text);
  return refusal(text);
}

TEST(TissueTable, TheShippedOneHasEveryNumberOfEveryTissueWithItsSource) {
  const TissueTable table = TissueTable::load(kAssets / "tissues.toml");
  for (const char* name : {"liver", "capsule", "gallbladder", "filled_gallbladder", "duct", "artery", "vein", "spleen",
                           "kidney", "bowel", "fat", "connective_bed", "abdominal_wall", "soft_tissue"})
    EXPECT_EQ(table.find(name).name, name);
  for (const TissueSolid& tissue : table.all())
    for (const auto& [key, number] : tissue.sources) {
      EXPECT_GT(number.source.size(), 7u) << tissue.name << " " << key;
      EXPECT_FALSE(number.checked && number.source.starts_with("from memory")) << tissue.name << " " << key;
    }
}

TEST(TissueTable, LiverIsWhatElastographySays) {
  const TissueSolid liver = TissueTable::load(kAssets / "tissues.toml").find("liver_segment_4");
  EXPECT_EQ(liver.name, "liver");
  EXPECT_EQ(liver.young_pa, 5000);
  EXPECT_EQ(liver.poisson, 0.45);
  EXPECT_EQ(liver.prony[0].share, 0.35);
  EXPECT_EQ(liver.prony[1].tau_s, 5);
  EXPECT_EQ(liver.toughness_j_per_m2, 164);
  EXPECT_TRUE(liver.sources.at("young_pa").checked);
  EXPECT_FALSE(liver.sources.at("share_1").checked);
}

TEST(TissueTable, NamesAnOrganAsTheMaterialsOfRigidOnesDo) {
  const TissueTable tissues = TissueTable::load(kAssets / "tissues.toml");
  const MaterialTable materials = MaterialTable::load(kAssets / "materials.toml");
  for (const TissueMaterial& material : materials.all()) {
    if (!tissues.knows(material.name)) continue;
    for (std::string alias : material.aliases) {
      if (alias.ends_with('*')) alias.back() = 'x';
      EXPECT_EQ(tissues.find(alias).name, tissues.find(material.name).name) << alias;
    }
  }
}

TEST(TissueTable, UnknownOrgansAreSoftTissueAndAMissingBranchTakesNoShare) {
  const std::string all = entry("soft_tissue");
  const std::string one = all.substr(0, all.find("share_2")) + all.substr(all.find("stiffening"));
  const TissueTable table = TissueTable::parse(one, "t.toml");
  EXPECT_FALSE(table.knows("something_else"));
  EXPECT_EQ(table.find("something_else").name, "soft_tissue");
  EXPECT_EQ(table.find("something_else").prony[1].share, 0);
}

TEST(TissueTable, SoftAndStiffAreTheEndsOfTheRange) {
  const TissueSolid tissue = TissueTable::parse(entry("soft_tissue"), "t.toml").find("soft_tissue");
  EXPECT_EQ(stiffness_choice(tissue, "soft").young_pa, 2000);
  EXPECT_EQ(stiffness_choice(tissue, "normal").young_pa, 5000);
  EXPECT_EQ(stiffness_choice(tissue, "stiff").young_pa, 9000);
  EXPECT_EQ(stiffness_choice(stiffness_choice(tissue, "stiff"), "normal").young_pa, 5000);
  EXPECT_THROW(stiffness_choice(tissue, "hard"), std::invalid_argument);
}

TEST(TissueTable, RefusesNumbersWithoutTheirUnitOrSource) {
  EXPECT_CONTAINS(
      refusal_with("{ value = 5000, range = [2000, 9000], unit = 'Pa', source = 's', checked = true }", "5000"),
      "t.toml:3:12: young_pa must be a table");
  EXPECT_CONTAINS(refusal_with("unit = 'Pa', ", ""), "t.toml:3:12: key \"unit\" is missing");
  EXPECT_CONTAINS(refusal_with("'Pa'", "'kPa'"), "t.toml:3:57: unit must be \"Pa\"");
  EXPECT_CONTAINS(refusal_with("source = 's', ", ""), "key \"source\" is missing");
  EXPECT_CONTAINS(refusal_with("checked = true", "checked = 'yes'"), "checked must be true or false");
}

TEST(TissueTable, RefusesNumbersThatCannotBe) {
  EXPECT_CONTAINS(refusal_with("value = 5000", "value = 9500"), "t.toml:3:22: value lies outside its own range");
  EXPECT_CONTAINS(refusal_with("2000, 9000", "9000, 2000"), "t.toml:3:36: range holds low and high");
  EXPECT_CONTAINS(refusal_with("2000, 9000", "0, 9000"), "range reaches beyond what young_pa can be");
  EXPECT_CONTAINS(refusal_with("0.45, 0.49", "0.45, 0.496"), "t.toml:5:35: range reaches beyond what poisson can be");
  EXPECT_CONTAINS(refusal_with("value = 0.25", "value = 0.65"), "t.toml:7:11: the shares add up to 1 or more");
  EXPECT_CONTAINS(refusal_with("value = 0.05", "value = 0.15"), "t.toml:16:14: mu_dynamic must lie in 0..mu_static");
}

TEST(TissueTable, RefusesKeysAndNamesThatItDoesNotKnow) {
  EXPECT_CONTAINS(refusal(entry("soft_tissue") + "colour = 'red'\n"), "t.toml:17:1: unknown key \"colour\"");
  EXPECT_CONTAINS(refusal_with("checked = true", "checked = true, page = 3"), "unknown key \"page\"");
  EXPECT_CONTAINS(refusal_with("tau_2_s", "tau_3_s"), "key \"tau_2_s\" is missing");
  EXPECT_CONTAINS(refusal(entry("soft_tissue") + entry("liver") + entry("liver")),
                  "t.toml:34:8: two tissues are named \"liver\"");
  EXPECT_CONTAINS(refusal(entry("liver")), "no tissue is named \"soft_tissue\"");
}

}  // namespace
}  // namespace trocar::tissue_table_test
