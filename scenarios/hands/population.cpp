#include "scenarios/hands/population.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr std::uint64_t kPersonSeed = 0x5ca1ab1e;  // of who a person is; attempts have seeds of their own

}  // namespace

std::pair<std::string, std::optional<int>> split_person(const std::string& hand) {
  const auto mark = hand.rfind('#');
  if (mark == std::string::npos || hand.ends_with(".toml")) return {hand, std::nullopt};
  int person = 0;
  const char* const last = hand.data() + hand.size();
  const auto [end, error] = std::from_chars(hand.data() + mark + 1, last, person);
  if (error != std::errc() || end != last || person < 1)
    throw InputError("hand '" + hand + "': behind # stands the number of a person, from 1");
  return {hand.substr(0, mark), person};
}

double latent_skill(int person) {
  const double turns = person * (std::numbers::phi - 1);
  return turns - std::floor(turns);
}

HandSkill skill_between(const HandSkill& least, const HandSkill& most, double skill) {
  HandSkill between = least;
  for (double HandSkill::*const number : kSkillNumbers) {
    const double a = least.*number, b = most.*number;
    between.*number = a > 0 && b > 0 ? a * std::pow(b / a, skill) : a + skill * (b - a);
  }
  between.max_corrections += static_cast<int>(std::lround(skill * (most.max_corrections - least.max_corrections)));
  return between;
}

HandSkill person_skill(const HandSkill& least, const HandSkill& most, double spread_cv, int person) {
  HandSkill skill = skill_between(least, most, latent_skill(person));
  skill.population_cv = spread_cv;
  HandRandom random(kPersonSeed + static_cast<std::uint64_t>(person));
  skill = drawn_person(skill, random);
  skill.population_cv = 0;
  return skill;
}

HandSkill drawn_person(const HandSkill& skill, HandRandom& random) {
  HandSkill person = skill;
  if (skill.population_cv <= 0) return person;
  for (double* value : {&person.speed_factor, &person.aim_lateral_m, &person.aim_depth_m, &person.aim_angle_rad,
                        &person.tremor_m, &person.pause_s, &person.force_bias, &person.force_cv, &person.path_bulge})
    *value *= random.log_normal(skill.population_cv);
  return person;
}

}  // namespace trocar
