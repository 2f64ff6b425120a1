// Plant files: whole and partial ones, options, refusals by line and column.
#include "scenarios/files/plant_file.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "haptics/device/plant/plant_fields.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"

namespace trocar::plant_file_test {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    parse_plant(text, "arm.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refusal(const std::string& text, const std::string& place, const std::string& words) {
  const std::string said = refusal_of(text);
  EXPECT_EQ(said.rfind("arm.toml:" + place + ":", 0), 0u) << text << "\n" << said;
  EXPECT_NE(said.find(words), std::string::npos) << text << "\n" << said;
}

void expect_same(PlantParameters a, PlantParameters b) {
  for (const auto fields : {plant_numbers(), option_numbers()}) {
    for (const PlantNumber& f : fields) EXPECT_EQ(f.at(a), f.at(b)) << f.table << ' ' << f.key;
  }
  for (const PlantVector& f : plant_vectors()) EXPECT_EQ(f.at(a), f.at(b)) << f.table << ' ' << f.key;
  for (int i = 0; i < kChannels; ++i) {
    for (const ChannelNumber& f : i == kPinchChannel ? pinch_numbers() : joint_numbers())
      EXPECT_EQ(f.at(a, i), f.at(b, i)) << f.key << ' ' << i;
    if (i == kPinchChannel) continue;
    for (const ChannelNumber& f : cable_numbers()) EXPECT_EQ(f.at(a, i), f.at(b, i)) << f.key << ' ' << i;
  }
  EXPECT_EQ(a.options.jitter_periods, b.options.jitter_periods);
  EXPECT_EQ(a.options.heat.on, b.options.heat.on);
}

TEST(PlantFileText, EveryPlantComesBackToTheBit) {
  expect_same(parse_plant(plant_toml(nominal_parameters(), "nominal"), "a").parameters, nominal_parameters());
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PlantParameters p = draw_everything(seed);
    p.stylus_products = {1e-6, -2e-6, 3e-7};
    if (seed % 2 == 0) {
      for (std::size_t i = 0; i < kArmJoints; ++i)
        p.options.cable[i] = {50.0 + static_cast<double>(seed * i), 0.01, 0.3};
      p.options.encoder = {1e-5, 100e3};
      p.options.heat.on = true;
      p.options.heat.start_c = 40;
      p.options.jitter_periods = 2;
    }
    expect_same(parse_plant(plant_toml(p, "a\nb"), "a").parameters, p);
  }
}

TEST(PlantFileText, OptionsThatAreOffStandAsCommentsThatWork) {
  std::string text = plant_toml(nominal_parameters(), "");
  EXPECT_NE(text.find("# [heat]"), std::string::npos);
  // Uncommenting the option tables must give a file that reads.
  for (const char* table : {"cable", "encoder", "heat", "delay", "sensor", "hand"}) {
    for (std::size_t at = text.find(std::string("# [") + table); at != std::string::npos && text[at] == '#';
         at = text.find('\n', at) + 1) {
      text.erase(at, 2);
      if (text.find('\n', at) == std::string::npos) break;
    }
  }
  const PlantFile plant = parse_plant(text, "a");
  EXPECT_EQ(plant.parameters.options.cable[5].stiffness, kNominalCable);
  EXPECT_TRUE(plant.parameters.options.heat.on);
  EXPECT_EQ(plant.parameters.options.jitter_periods, 2);
  EXPECT_GT(plant.parameters.options.encoder.limit_hz, 0);
  ASSERT_TRUE(plant.sensor && plant.hand);
  EXPECT_TRUE(plant.hand->reaction.on);
}

TEST(PlantFile, WhatIsNotGivenStaysNominalOrDrawn) {
  expect_same(parse_plant("# nothing\n", "a").parameters, nominal_parameters());
  expect_same(parse_plant("seed = 7\n", "a").parameters, draw_parameters(7));
  expect_same(parse_plant("seed = 7\nvariation = \"all\"\n", "a").parameters, draw_everything(7));
  PlantParameters wanted = draw_parameters(7);
  wanted.stylus_mass = 0.12;
  wanted.channel[3].friction.coulomb = 0.05;
  expect_same(parse_plant("seed = 7\n[stylus]\nmass_kg = 0.12\n[th4]\ncoulomb_n_m = 0.05\n", "a").parameters, wanted);
}

TEST(PlantFile, OneJointGoesBeforeAllJoints) {
  const PlantParameters p =
      parse_plant("[th2]\nviscous_n_m_s_per_rad = 0.02\n[joints]\nviscous_n_m_s_per_rad = 0.01\n", "a").parameters;
  EXPECT_EQ(p.channel[0].friction.viscous, 0.01);
  EXPECT_EQ(p.channel[1].friction.viscous, 0.02);
  EXPECT_EQ(p.channel[kPinchChannel].friction.viscous, nominal_parameters().channel[kPinchChannel].friction.viscous);
}

TEST(PlantFile, ATableSwitchesItsOptionOn) {
  const PlantOptions o =
      parse_plant("[cable]\n[cable.th4]\nstiffness_n_m_per_rad = 60\n[heat]\n", "a").parameters.options;
  EXPECT_EQ(o.cable[0].stiffness, kNominalCable);
  EXPECT_EQ(o.cable[3].stiffness, 60);
  EXPECT_TRUE(o.heat.on);
  EXPECT_EQ(o.jitter_periods, 0);
  const PlantOptions rigid_elbow = parse_plant("[cable]\nth4 = {stiffness_n_m_per_rad = 0}\n", "a").parameters.options;
  EXPECT_EQ(rigid_elbow.cable[3].stiffness, 0);
}

TEST(PlantFile, HandAndSensor) {
  const PlantFile plain = parse_plant("[sensor]\nfixture_kg = 0.08\n[hand]\ngrip = \"light\"\n", "a");
  EXPECT_EQ(plain.hand->grip_stiffness, 150);
  EXPECT_FALSE(plain.hand->reaction.on);
  EXPECT_EQ(plain.sensor->fixture_kg, 0.08);
  EXPECT_EQ(plain.sensor->force.rate_hz, 40);
  const PlantFile drawn = parse_plant("seed = 5\n[hand]\ndrawn = true\nreacts = true\nreflex_s = 0.045\n", "a");
  EXPECT_EQ(drawn.hand->grip_stiffness, draw_hand_parameters(GripPreset::kNormal, 5).grip_stiffness);
  EXPECT_EQ(drawn.hand->reaction.firm_s, draw_hand_reaction(5).firm_s);
  EXPECT_EQ(drawn.hand->reaction.reflex_s, 0.045);
  EXPECT_FALSE(parse_plant("seed = 5\n", "a").hand);
}

TEST(PlantFile, DegenerateDevicesAreRefusedAtTheirLine) {
  expect_refusal("[stylus]\nmass_kg = -0.1\n", "2:11", "out of range");
  expect_refusal("[stylus]\nmass_kg = 0\n", "2:11", "out of range");
  expect_refusal("[stylus]\ninertia_kg_m2 = [8e-5, 8e-5, -1e-5]\n", "2:17", "not positive definite");
  expect_refusal("[stylus]\ninertia_kg_m2 = [8e-5, 1e-5, 1e-5]\n", "2:17", "exceeds the sum");
  expect_refusal("[stylus]\nproducts_kg_m2 = [9e-5, 0, 0]\n", "1:1", "not positive definite");
  expect_refusal("[joints]\ncoulomb_n_m = -0.01\n", "2:15", "out of range");
  expect_refusal("[joints]\nstribeck_ratio = 0.9\n", "2:18", "out of range 1 to");
  expect_refusal("[th3]\nratio = 0\n", "2:9", "out of range");
  expect_refusal("[joints]\nresistance_ohm = 0\n", "2:18", "out of range");
  expect_refusal("[electronics]\ncounts_per_turn = 0.5\n", "2:19", "out of range 1 to");
  expect_refusal("[electronics]\ndac_full_scale_v = 0\n", "2:20", "out of range");
  expect_refusal("[arm]\nlink1_m = 0.12\n", "2:11", "home pose");
  expect_refusal("[arm]\ngravity_m_s2 = nan\n", "2:16", "finite");
  expect_refusal("[arm]\ngravity_m_s2 = inf\n", "2:16", "finite");
  expect_refusal("[joints]\nstop_upper_rad = 0.5\n", "2:18", "home pose");
  expect_refusal("[th5]\nstop_lower_rad = 0.1\n", "1:1", "above the lower");
  expect_refusal("[hand]\nreacts = true\nfirm_s = 0.1\n", "3:10", "after 'reaction_s'");
}

TEST(PlantFile, WrongNamesUnitsAndTypesAreRefused) {
  expect_refusal("[stylus]\nmass_g = 77\n", "2:1", "did you mean 'mass_kg'");
  expect_refusal("[joints]\ncoulomb_mn_m = 7.5\n", "2:1", "did you mean 'coulomb_n_m'");
  expect_refusal("[joints]\ncoulomb_n_m = 7.5\n", "2:15", "out of range");  // mN m taken for N m
  expect_refusal("[jaws]\nmass_kg = 1\n", "1:2", "did you mean 'jaw'");
  expect_refusal("[gravity]\nplatform_n_m = [0, 0, 0]\n", "1:2", "unknown key 'gravity'");  // a device file
  expect_refusal("[heat]\non = true\n", "2:1", "unknown key 'on'");
  expect_refusal("variation = \"all\"\n", "1:13", "needs a 'seed'");
  expect_refusal("variation = \"most\"\nseed = 1\n", "1:13", "known are all");
  expect_refusal("seed = -1\n", "1:8", "out of range");
  expect_refusal("seed = 1.5\n", "1:8", "whole number");
  expect_refusal("[delay]\njitter_periods = 64\n", "2:18", "out of range 0 to 63");
  expect_refusal("[delay]\n", "1:1", "missing key 'jitter_periods'");
  expect_refusal("[th6]\nstop_upper_rad = \"never\"\n", "2:18", "a number or \"none\"");
  expect_refusal("[hand]\ndrawn = true\n", "2:9", "needs the file's 'seed'");
  expect_refusal("[stylus\nmass_kg = 1\n", "1:8", "");
}

TEST(PlantFile, OnDiskItHasANameAndADigest) {
  const auto file = std::filesystem::temp_directory_path() / ("trocar_plant_" + std::to_string(::getpid()) + ".toml");
  const std::string text = "seed = 3\n";
  std::ofstream(file, std::ios::binary) << text;
  const PlantFile plant = load_plant(file);
  EXPECT_EQ(plant.name, file.filename().string());
  EXPECT_EQ(plant.sha256, digest::of_bytes(text));
  for (const char* nothing : {"", "  \n"}) {
    std::ofstream(file, std::ios::binary) << nothing;
    try {
      load_plant(file);
      ADD_FAILURE() << "an empty file is no plant";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("is empty"), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove(file);
  EXPECT_THROW(load_plant(file), InputError);
  EXPECT_THROW(load_plant(std::filesystem::temp_directory_path()), InputError) << "a folder";
}

}  // namespace
}  // namespace trocar::plant_file_test
