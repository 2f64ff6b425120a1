#include "app/graphics/tissue_painter.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/graphics/picture_mesh.h"

namespace trocar {
namespace {

constexpr std::size_t kNeighbourTriangles = 16000;  // in the picture, each

/// Look of every material whose name holds the word; the first that fits counts.
constexpr std::pair<std::string_view, std::string_view> kLooks[] = {
    {"liver", "LOOK_LIVER"},     {"gallbladder", "LOOK_GALLBLADDER"}, {"duct", "LOOK_DUCT"},     {"biliary", "LOOK_DUCT"},
    {"fat", "LOOK_FAT"},         {"omentum", "LOOK_FAT"},             {"mesenter", "LOOK_FAT"},  {"spleen", "LOOK_SPLEEN"},
    {"kidney", "LOOK_KIDNEY"},   {"artery", "LOOK_ARTERY"},           {"aorta", "LOOK_ARTERY"},  {"vein", "LOOK_VEIN"},
    {"cava", "LOOK_VEIN"},       {"pancreas", "LOOK_PANCREAS"},       {"adrenal", "LOOK_PANCREAS"}, {"vertebra", "LOOK_BONE"},
    {"spine", "LOOK_BONE"},      {"bone", "LOOK_BONE"},               {"hip", "LOOK_BONE"},      {"rib", "LOOK_BONE"}};

}  // namespace

std::string tissue_look(const std::string& material) {
  for (const auto& [word, look] : kLooks)
    if (material.find(word) != std::string::npos) return std::string(look);
  return "LOOK_FLESH";
}

void TissuePainter::prepare(const std::vector<NeighbourView>& neighbours) {
  std::vector<Kept> now;
  for (const NeighbourView& neighbour : neighbours) {
    if (!neighbour.surface || neighbour.surface->triangles.empty()) continue;
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) { return one.source.lock() == neighbour.surface; });
    if (found != kept_.end())
      now.push_back(std::move(*found));
    else
      now.push_back({neighbour.surface, {}, GpuMesh(build_picture_mesh(*neighbour.surface, kNeighbourTriangles))});
    now.back().look = tissue_look(neighbour.material);
  }
  kept_ = std::move(now);
}

void TissuePainter::draw_shadows() {
  for (Kept& one : kept_) one.mesh.draw();
}

void TissuePainter::draw(const ProgramBinder& bind) {
  for (Kept& one : kept_) {
    bind("tissue", "tissue", {one.look});
    one.mesh.draw();
  }
}

}  // namespace trocar
