// Persons between a novice and an expert: the same person whoever asks, spread evenly, each with a skill of its own.
#include "scenarios/hands/population.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/input_error.h"
#include "scenarios/hands/make_hand.h"

namespace trocar::population_test {
namespace {

const std::filesystem::path kHandsFolder = TROCAR_SOURCE_DIR "/scenarios/hands";

HandSkill skill_named(const char* name) { return load_hand_script(kHandsFolder / (std::string(name) + ".toml")).skill; }

std::string refusal_of(const std::string& hand) {
  try {
    make_hand(hand, 1, kHandsFolder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Population, LatentSkillsAreSpreadEvenly) {
  std::vector<double> skills;
  for (int person = 1; person <= 100; ++person) skills.push_back(latent_skill(person));
  std::sort(skills.begin(), skills.end());
  EXPECT_GE(skills.front(), 0);
  EXPECT_LT(skills.back(), 1);
  for (std::size_t i = 1; i < skills.size(); ++i) EXPECT_LT(skills[i] - skills[i - 1], 0.025) << i;
}

TEST(Population, TheEndsAreTheHandsAndTheMiddleIsGeometric) {
  const HandSkill novice = skill_named("novice"), expert = skill_named("expert");
  EXPECT_DOUBLE_EQ(skill_between(novice, expert, 0).aim_depth_m, novice.aim_depth_m);
  EXPECT_DOUBLE_EQ(skill_between(novice, expert, 1).pause_s, expert.pause_s);
  EXPECT_NEAR(skill_between(novice, expert, 0.5).speed_factor, std::sqrt(2.1), 1e-12);
  HandSkill with = novice, without = novice;
  with.tremor_m = 0.002;
  without.tremor_m = 0;
  with.max_corrections = 0;
  without.max_corrections = 3;
  EXPECT_NEAR(skill_between(without, with, 0.25).tremor_m, 0.0005, 1e-15) << "straight where one is 0";
  EXPECT_EQ(skill_between(without, with, 0.5).max_corrections, 1) << "3 - 1.5, away from zero";
}

TEST(Population, APersonIsTheSameWhateverTheAttempt) {
  const HandSkill novice = skill_named("novice"), expert = skill_named("expert");
  const HandSkill once = person_skill(novice, expert, 0.2, 17), again = person_skill(novice, expert, 0.2, 17);
  EXPECT_EQ(once.speed_factor, again.speed_factor);
  EXPECT_EQ(once.population_cv, 0) << "drawn already";
  const HandSkill mean = skill_between(novice, expert, latent_skill(17));
  EXPECT_NE(once.speed_factor, mean.speed_factor);
  EXPECT_EQ(person_skill(novice, expert, 0, 17).speed_factor, mean.speed_factor) << "without spread";
}

TEST(Population, PersonsSpreadAboutTheirSkill) {
  const HandSkill novice = skill_named("novice"), expert = skill_named("expert");
  double sum = 0, squares = 0;
  constexpr int kPersons = 1000;
  for (int person = 1; person <= kPersons; ++person) {
    const double ratio =
        person_skill(novice, expert, 0.2, person).pause_s / skill_between(novice, expert, latent_skill(person)).pause_s;
    sum += ratio;
    squares += ratio * ratio;
  }
  const double mean = sum / kPersons;
  EXPECT_NEAR(mean, 1, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kPersons - mean * mean), 0.2, 0.03);
}

TEST(Population, NamesOfPersons) {
  EXPECT_EQ(split_person("population#17"), (std::pair<std::string, std::optional<int>>("population", 17)));
  EXPECT_EQ(split_person("expert").second, std::nullopt);
  EXPECT_EQ(split_person("a#b/mine.toml").first, "a#b/mine.toml");
  EXPECT_EQ(refusal_of("population#17"), "accepted");
  EXPECT_NE(refusal_of("population").find("name one of it, population#1"), std::string::npos);
  EXPECT_NE(refusal_of("population#0").find("the number of a person, from 1"), std::string::npos);
  EXPECT_NE(refusal_of("population#x").find("the number of a person"), std::string::npos);
  EXPECT_NE(refusal_of("expert#3").find("is no population"), std::string::npos);
}

TEST(Population, TheBytesOfAHandAreThoseOfAllItIsMadeOf) {
  const std::string bytes = hand_bytes("population#3", kHandsFolder);
  EXPECT_EQ(bytes, hand_bytes("population#4", kHandsFolder));
  EXPECT_NE(bytes.find("name = \"novice\""), std::string::npos);
  EXPECT_NE(hand_bytes("learner", kHandsFolder).find("name = \"expert\""), std::string::npos);
}

}  // namespace
}  // namespace trocar::population_test
