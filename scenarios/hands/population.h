// Persons of a population: who they are does not depend on how many there are, nor on the seed of an attempt.
//
// A latent skill in 0..1 lies between two hands, a novice and an expert; every number of a person's skill then has a
// log-normal factor of its own, as people of one level differ. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "scenarios/hands/hand_random.h"
#include "scenarios/hands/hand_script.h"

namespace trocar {

/// "population#17" as name and number; no number without "#". @throws InputError when what follows is no number from 1.
std::pair<std::string, std::optional<int>> split_person(const std::string& hand);

/// Latent skill of a person, 0..1: any number of persons from 1 on is spread evenly (multiples of the golden ratio).
double latent_skill(int person);

/// Skill between two: geometric where both numbers are positive, straight elsewhere and for the counted corrections.
HandSkill skill_between(const HandSkill& least, const HandSkill& most, double skill);

/// The skill of a person of a population. population_cv is 0: the person is drawn already.
HandSkill person_skill(const HandSkill& least, const HandSkill& most, double spread_cv, int person);

/// One person of those whom a skill with a population_cv describes.
HandSkill drawn_person(const HandSkill& skill, HandRandom& random);

}  // namespace trocar
