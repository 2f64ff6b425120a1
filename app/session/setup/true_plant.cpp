#include "app/session/setup/true_plant.h"

#include <nlohmann/json.hpp>

namespace trocar {

TruePlant true_plant(const std::filesystem::path& file, std::uint64_t seed) {
  if (file.empty()) return {draw_parameters(seed), "seed " + std::to_string(seed)};
  const PlantFile plant = load_plant(file);
  return {plant.parameters, plant_words(plant)};
}

std::string plant_words(const PlantFile& plant) {
  return "plant file " + plant.name + ", sha256 " + plant.sha256.substr(0, 8);
}

std::string plant_json(const PlantFile& plant) {
  return nlohmann::ordered_json{{"file", plant.name}, {"sha256", plant.sha256}}.dump();
}

}  // namespace trocar
