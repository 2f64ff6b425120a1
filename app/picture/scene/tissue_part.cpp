#include "app/picture/scene/tissue_part.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "app/picture/scene/mark_block.h"

namespace trocar {
namespace {

/// In the order of TissueMarkKind.
constexpr std::array<std::string_view, 4> kFieldNames = {"blood", "char", "whitening", "wet"};
constexpr std::uint8_t kLeastField = 4;  // of 255: less than this shows nothing

}  // namespace

TissuePart::TissuePart(PictureMesh scenery) : mesh_(std::move(scenery)) {
  for (const PictureVertex& v : mesh_.vertices) rest_box_.extend(Vec3(v.position[0], v.position[1], v.position[2]));
  box_ = rest_box_;
  gpu_ = GpuMesh(mesh_);
}

TissuePart::TissuePart(const SurfacePtr& surface, std::size_t max_triangles) : rest_(surface_at_rest(surface)) {
  const SurfaceSnapshot& rest = *surface_at_rest(surface);
  subdivision_.emplace(rest, max_triangles);
  own_grid_.emplace(subdivision_->fine());
  mesh_ = bake_picture_mesh(subdivision_->fine(), *own_grid_);
  gpu_ = GpuMesh(mesh_);
  grid_.emplace(rest);
  box_ = rest_box_ = rest.bounds();
}

bool TissuePart::follow(const SurfacePtr& surface) {
  if (shown_.lock() == surface) return false;
  shown_ = surface;
  moves_ = moves_ || surface->rest;
  if (moves_) {
    const TriangleSurface& fine = subdivision_->move(surface->vertices);
    grid_.emplace(fine, *own_grid_);
    steady_ = bake_vertices(fine, *grid_);
    box_ = surface->bounds();
  }
  show_fields(*surface);
  return true;
}

void TissuePart::show_fields(const SurfaceSnapshot& surface) {
  const bool had = bears_fields();
  fields_.clear();
  for (const SurfaceField& field : surface.fields) {
    const auto name = std::find(kFieldNames.begin(), kFieldNames.end(), field.name);
    if (name == kFieldNames.end()) continue;
    const std::vector<float> values = subdivision_->spread(field.value);
    fields_.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      fields_[i][static_cast<std::size_t>(name - kFieldNames.begin())] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(values[i], 0.0F, 1.0F)));
  }
  if (bears_fields()) gpu_.set_fields(fields_);
  if (had || bears_fields()) gather_marked();
}

void TissuePart::mark(const std::vector<TissueMark>& marks) {
  under_marks_ = triangles_marked(mesh_, marks);
  gather_marked();
}

void TissuePart::gather_marked() {
  const auto bears = [this](std::uint32_t vertex) {
    return *std::max_element(fields_[vertex].begin(), fields_[vertex].end()) >= kLeastField;
  };
  std::vector<std::uint32_t> indices;
  if (!bears_fields()) indices = under_marks_;
  auto next = under_marks_.begin();  // in the order of the mesh
  for (auto triangle = mesh_.indices.begin(); bears_fields() && triangle != mesh_.indices.end(); triangle += 3) {
    const bool under_mark = next != under_marks_.end() && std::equal(triangle, triangle + 3, next);
    if (under_mark) next += 3;
    if (under_mark || std::any_of(triangle, triangle + 3, bears)) indices.insert(indices.end(), triangle, triangle + 3);
  }
  marked_count_ = static_cast<int>(indices.size());
  marked_ = marked_count_ > 0 ? upload_indices(indices) : GlObject();
}

}  // namespace trocar
