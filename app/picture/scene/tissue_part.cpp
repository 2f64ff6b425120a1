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
constexpr float kBesideLip = 1;          // mm from the lip that are drawn as a cut
constexpr float kDark_mm = 3;            // of depth in which a wall loses light
constexpr float kLeftDeep = 0.30F;       // of the light, far down

/// One of the parts of a surface. @param vertices of the surface, that it has
SurfaceSnapshot part_of(const SurfaceSnapshot& surface, std::uint8_t part, std::vector<std::int32_t>& vertices) {
  SurfaceSnapshot out;
  std::vector<std::int32_t> number(surface.vertices.size(), -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.part[t] != part) continue;
    auto triangle = surface.triangles[t];
    for (std::int32_t& corner : triangle) {
      std::int32_t& now = number[static_cast<std::size_t>(corner)];
      if (now < 0) {
        now = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(corner);
        out.vertices.push_back(surface.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = now;
    }
    out.triangles.push_back(triangle);
    if (!surface.inside.empty()) out.inside.push_back(surface.inside[t]);
  }
  return out;
}

}  // namespace

TissuePart::TissuePart(PictureMesh scenery) : mesh_(std::move(scenery)) {
  for (const PictureVertex& v : mesh_.vertices) rest_box_.extend(Vec3(v.position[0], v.position[1], v.position[2]));
  box_ = rest_box_;
  gpu_ = GpuMesh(mesh_);
}

TissuePart::TissuePart(const SurfacePtr& surface, std::size_t max_triangles, std::uint8_t part)
    : rest_(surface_at_rest(surface)) {
  const SurfaceSnapshot& whole = *surface_at_rest(surface);
  const SurfaceSnapshot rest = whole.part.empty() ? whole : part_of(whole, part, own_vertices_);
  seams_ = open_seams(rest);
  subdivision_.emplace(seams_.surface, max_triangles, seams_.straight);
  own_grid_.emplace(subdivision_->fine());
  mesh_ = bake_picture_mesh(subdivision_->fine(), *own_grid_);
  if (!rest.inside.empty()) find_cuts(rest.inside);
  show_cuts(mesh_.vertices);
  gpu_ = GpuMesh(mesh_);
  grid_.emplace(rest);
  box_ = rest_box_ = rest.bounds();
}

void TissuePart::find_cuts(const std::vector<bool>& inside) {
  const TriangleSurface& fine = subdivision_->fine();
  const std::size_t pieces = fine.triangles.size() / inside.size();
  std::vector<bool> fine_inside(fine.triangles.size());
  for (std::size_t t = 0; t < fine_inside.size(); ++t) fine_inside[t] = inside[t / pieces];
  cut_places_ = cut_places(fine, fine_inside);
  cut_triangle_.resize(fine.triangles.size());
  std::vector<std::uint32_t> indices;
  for (std::size_t t = 0; t < cut_triangle_.size(); ++t) {
    const auto* corners = &mesh_.indices[3 * t];
    cut_triangle_[t] =
        std::any_of(corners, corners + 3, [&](std::uint32_t v) { return cut_places_[v] > kLipOutside - kBesideLip; });
    if (cut_triangle_[t]) indices.insert(indices.end(), corners, corners + 3);
  }
  cut_count_ = static_cast<int>(indices.size());
  cut_ = upload_indices(indices);
}

void TissuePart::show_cuts(std::vector<PictureVertex>& vertices) const {
  for (std::size_t v = 0; v < cut_places_.size(); ++v) {
    vertices[v].light[1] = cut_places_[v];
    if (cut_places_[v] >= kLipOfWall)
      vertices[v].light[0] *= kLeftDeep + (1 - kLeftDeep) * std::exp((kLipOfWall - cut_places_[v]) / kDark_mm);
  }
}

bool TissuePart::follow(const SurfacePtr& surface) {
  if (shown_.lock() == surface) return false;
  shown_ = surface;
  moves_ = moves_ || surface->rest;
  if (moves_) {
    const std::vector<Vec3> vertices = own(surface->vertices);
    const TriangleSurface& fine = subdivision_->move(seams_.at_twins_too(vertices));
    grid_.emplace(fine, *own_grid_);
    steady_ = bake_vertices(fine, *grid_);
    show_cuts(steady_);
    box_ = TriangleSurface{vertices, {}}.bounds();
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
    const std::vector<float> values = subdivision_->spread(seams_.at_twins_too(own(field.value)));
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
  const bool all = bears_fields() || cut();
  if (!all) indices = under_marks_;
  auto next = under_marks_.begin();  // in the order of the mesh
  std::size_t t = 0;
  for (auto triangle = mesh_.indices.begin(); all && triangle != mesh_.indices.end(); triangle += 3, ++t) {
    const bool under_mark = next != under_marks_.end() && std::equal(triangle, triangle + 3, next);
    if (under_mark) next += 3;
    if (!cut_triangle_.empty() && cut_triangle_[t]) continue;
    if (under_mark || (bears_fields() && std::any_of(triangle, triangle + 3, bears)))
      indices.insert(indices.end(), triangle, triangle + 3);
  }
  marked_count_ = static_cast<int>(indices.size());
  marked_ = marked_count_ > 0 ? upload_indices(indices) : GlObject();
}

}  // namespace trocar
