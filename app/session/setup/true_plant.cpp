#include "app/session/setup/true_plant.h"

#include <nlohmann/json.hpp>

#include "haptics/digest/digest.h"

namespace trocar {

TruePlant true_plant(const std::filesystem::path& file, std::uint64_t seed) {
  if (file.empty()) return {draw_parameters(seed), "seed " + std::to_string(seed)};
  const PlantFile plant = load_plant(file);
  return {plant.parameters, plant_words(plant)};
}

std::string plant_words(const PlantFile& plant) {
  return "plant file " + plant.name + ", sha256 " + plant.sha256.substr(0, 8);
}

std::string plant_json(const PlantFile* plant, std::int64_t seed, const DeviceFiles& known) {
  using Json = nlohmann::ordered_json;
  Json json = plant ? Json{{"file", plant->name}, {"sha256", plant->sha256}} : Json{{"seed", seed}};
  const auto file = [](const std::optional<DeviceFile>& f) {
    return f ? Json{{"file", f->name}, {"sha256", digest::of_bytes(f->text)}} : Json(nullptr);
  };
  json["calibration"] = file(known.calibration);
  json["identification"] = file(known.identified);
  return json.dump();
}

}  // namespace trocar
