#include "app/picture/scene/tissue_painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "app/picture/models/picture_mesh.h"
#include "app/picture/scene/backdrop.h"
#include "app/picture/scene/mark_block.h"
#include "app/picture/scene/scene_block.h"

namespace trocar {
namespace {

/// Look of every material whose name holds the word; the first that fits counts.
constexpr std::pair<std::string_view, std::string_view> kLooks[] = {
    {"liver", "LOOK_LIVER"},      {"gallbladder", "LOOK_GALLBLADDER"},
    {"duct", "LOOK_DUCT"},        {"biliary", "LOOK_DUCT"},
    {"fat", "LOOK_FAT"},          {"omentum", "LOOK_FAT"},
    {"mesenter", "LOOK_FAT"},     {"spleen", "LOOK_SPLEEN"},
    {"kidney", "LOOK_KIDNEY"},    {"artery", "LOOK_ARTERY"},
    {"aorta", "LOOK_ARTERY"},     {"vein", "LOOK_VEIN"},
    {"cava", "LOOK_VEIN"},        {"pancreas", "LOOK_PANCREAS"},
    {"adrenal", "LOOK_PANCREAS"}, {"vertebra", "LOOK_BONE"},
    {"spine", "LOOK_BONE"},       {"bone", "LOOK_BONE"},
    {"hip", "LOOK_BONE"},         {"rib", "LOOK_BONE"},
    {"gauze", "LOOK_BONE"}};  // as pale

/// A gallbladder alone lies on the liver; everything else on fat.
std::string bed_look(const SceneView& view) {
  return view.material == "gallbladder" && view.adjacent.empty() ? "LOOK_LIVER" : "LOOK_FAT";
}

/// A scene with fat of its own needs no bed of it.
bool brings_fat(const SceneView& view) {
  return std::any_of(view.adjacent.begin(), view.adjacent.end(),
                     [](const AdjacentOrganView& one) { return tissue_look(one.material) == "LOOK_FAT"; });
}

/// The organs beside the one in the middle that have something to draw.
std::vector<const AdjacentOrganView*> drawn_beside(const SceneView& view) {
  std::vector<const AdjacentOrganView*> out;
  for (const AdjacentOrganView& other : view.adjacent)
    if (other.surface && !other.surface->triangles.empty()) out.push_back(&other);
  return out;
}

std::string mark_look(TargetMark::State state) {
  switch (state) {
    case TargetMark::State::kWaiting:
      return "MARK_WAITING";
    case TargetMark::State::kLit:
      return "MARK_LIT";
    case TargetMark::State::kDone:
      return "MARK_DONE";
  }
  return "MARK_WAITING";
}

void set_vector(int location, const Vec3& v, double w) {
  glUniform4f(location, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
              static_cast<float>(w));
}
void set_vector(int location, const Vec3& v) {
  glUniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

/// Height of the bed of fat, whose vertices stand in rows on an even grid, under a point; far below outside it.
double bed_height(const PictureMesh& bed, const Eigen::AlignedBox3d& box, const Vec3& p) {
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(bed.vertices.size()))));
  const Eigen::Vector2d at =
      (p - box.min()).head<2>().cwiseQuotient(box.sizes().head<2>()) * static_cast<double>(side - 1);
  if ((at.array() < 0).any() || (at.array() > static_cast<double>(side - 1)).any()) return -1e9;
  const auto row = static_cast<std::size_t>(std::lround(at.x())),
             column = static_cast<std::size_t>(std::lround(at.y()));
  return bed.vertices[row * side + column].position[2];
}

/// Takes light from what lies close over the bed.
void darken_over(std::vector<PictureVertex>& vertices, const PictureMesh& bed, const Eigen::AlignedBox3d& bed_box) {
  constexpr double kReach_m = 0.009;
  for (PictureVertex& vertex : vertices) {
    const double gap =
        vertex.position[2] - bed_height(bed, bed_box, Vec3(vertex.position[0], vertex.position[1], vertex.position[2]));
    const double down = std::clamp(0.75 - 0.6 * vertex.normal[2], 0.0, 1.0);  // what faces up is hardly hidden by it
    vertex.light[0] *= static_cast<float>(1 - 0.75 * down * std::exp(-std::max(gap, 0.0) / kReach_m));
  }
}

/// Whether any of a box can lie in the round field.
bool in_field(const Eigen::AlignedBox3d& box, const Camera& camera, const ScopeOptics& optics) {
  const double radius = 0.5 * box.diagonal().norm();
  const Vec3 to = box.center() - optics.eye();
  const double distance = to.norm();
  if (distance <= radius) return true;
  const double off = std::acos(std::clamp(to.dot(optics.forward()) / distance, -1.0, 1.0));
  return off - std::asin(radius / distance) < 0.5 * camera.diagonal_fov_deg * std::numbers::pi / 180;
}

}  // namespace

std::string tissue_look(const std::string& material) {
  for (const auto& [word, look] : kLooks)
    if (material.find(word) != std::string::npos) return std::string(look);
  return "LOOK_FLESH";
}

std::vector<TissuePart*> TissuePainter::parts() {
  std::vector<TissuePart*> all;
  for (auto* one : {&organ_, &second_, &fat_, &wall_})
    if (*one) all.push_back(&**one);
  for (TissuePart& one : adjacent_) all.push_back(&one);
  return all;
}

bool TissuePainter::built_for(const SceneView& view, const PresetTraits& traits) const {
  const std::vector<const AdjacentOrganView*> others = drawn_beside(view);
  return built_preset_ == traits.define && organ_ && organ_->made_from(view.organ) &&
         std::equal(
             adjacent_.begin(), adjacent_.end(), others.begin(), others.end(),
             [](const TissuePart& part, const AdjacentOrganView* other) { return part.made_from(other->surface); });
}

/// What is there already is kept: where tissue is cut, one organ is made anew and not twenty.
void TissuePainter::build(const SceneView& view, const PresetTraits& traits) {
  std::vector<TissuePart> before = std::exchange(adjacent_, {});
  if (built_preset_ != traits.define) {
    before.clear();
    organ_.reset();
  }
  if (!organ_ || !organ_->made_from(view.organ)) {
    organ_.emplace(view.organ, traits.organ_triangles);
    second_.reset();
    if (!surface_at_rest(view.organ)->part.empty()) second_.emplace(view.organ, traits.adjacent_triangles, 1);
  }
  Eigen::AlignedBox3d bounds = organ_->box_at_rest();
  if (second_) bounds.extend(second_->box_at_rest());
  for (const AdjacentOrganView* other : drawn_beside(view)) {
    const auto same = std::find_if(before.begin(), before.end(),
                                   [&](const TissuePart& part) { return part.made_from(other->surface); });
    if (same == before.end()) {
      adjacent_.emplace_back(other->surface, traits.adjacent_triangles);
    } else {
      adjacent_.push_back(std::move(*same));
      before.erase(same);
    }
    bounds.extend(adjacent_.back().box_at_rest());
  }
  if (!wall_ || bounds.min() != bounds_.min() || bounds.max() != bounds_.max()) {
    wall_.emplace(build_cavity(bounds));
    fat_.reset();
  }
  if (brings_fat(view))
    fat_.reset();
  else if (!fat_)
    fat_.emplace(build_fat_bed(bounds));
  bounds_ = bounds;
  built_preset_ = traits.define;
}

/// Of what stands still, every organ takes light from every other and from the fat beside it.
void TissuePainter::light_still() {
  std::vector<TissuePart*> still = parts();
  std::erase_if(still, [](const TissuePart* part) { return part->moves(); });
  for (TissuePart* one : still) {
    one->take_own_light();
    for (TissuePart* other : still)
      if (one != other && one != &*wall_ && one->beside(*other)) one->darken_by(*other);
    if (fat_ && one != &*wall_ && one != &*fat_) darken_over(one->vertices(), fat_->mesh(), fat_->box());
    one->keep_as_steady();
    one->beside_moving = false;
    one->send();
  }
}

/// What moves takes light from everything, and everything from what moves.
void TissuePainter::light_moving() {
  const std::vector<TissuePart*> all = parts();
  for (TissuePart* one : all) {
    if (one == &*wall_) continue;
    std::vector<const TissuePart*> by;
    for (const TissuePart* other : all)
      if (one != other && (one->moves() || other->moves()) && one->beside(*other)) by.push_back(other);
    const bool was_beside = std::exchange(one->beside_moving, !by.empty());
    if (!one->moves() && !was_beside && by.empty()) continue;
    one->take_steady_light();
    for (const TissuePart* other : by) one->darken_by(*other);
    if (fat_ && one->moves()) darken_over(one->vertices(), fat_->mesh(), fat_->box());
    one->send();
  }
}

void TissuePainter::follow(const SceneView& view, bool built) {
  bool changed = built;
  const auto follow = [&](TissuePart& part, const SurfacePtr& surface) {
    const bool stood = !part.moves();
    changed = part.follow(surface) || changed;
    built = built || (stood && part.moves());
  };
  follow(*organ_, view.organ);
  if (second_) follow(*second_, view.organ);
  std::size_t i = 0;
  for (const AdjacentOrganView* other : drawn_beside(view)) follow(adjacent_[i++], other->surface);
  if (built) {
    light_still();
    ++version_;
  }
  if (changed) light_moving();
}

void TissuePainter::prepare(const SceneView& view, const PresetTraits& traits) {
  if (!view.organ || view.organ->triangles.empty()) {
    if (!organ_) return;
    const int next = version_ + 1;
    *this = {};
    version_ = next;
    return;
  }
  const bool build_anew = !built_for(view, traits);
  if (build_anew) {
    decals_.clear();
    marks_.clear();
    build(view, traits);
  }
  follow(view, build_anew);
  organ_->look = tissue_look(view.material);
  if (second_) second_->look = tissue_look(view.second_material);
  if (fat_) fat_->look = bed_look(view);
  wall_->look = "LOOK_WALL";
  std::size_t i = 0;
  for (const AdjacentOrganView* other : drawn_beside(view)) adjacent_[i++].look = tissue_look(other->material);
  prepare_marks(view);
  prepare_decals(view);
}

void TissuePainter::prepare_marks(const SceneView& view) {
  if (mark_block_.id() != 0 && marks_ == view.marks) return;
  marks_ = view.marks;
  if (marks_.size() > kMaxTissueMarks) marks_.resize(kMaxTissueMarks);
  if (mark_block_.id() == 0) mark_block_ = GlObject(GlObject::Kind::kBuffer);
  const MarkBlock block = make_mark_block(marks_);
  glBindBuffer(GL_UNIFORM_BUFFER, mark_block_.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  for (TissuePart* part : parts()) part->mark(marks_);
  marks_ = view.marks;
}

void TissuePainter::prepare_decals(const SceneView& view) {
  bool same = decals_.size() == view.targets.size();
  for (std::size_t i = 0; same && i < decals_.size(); ++i)
    same = decals_[i].centre_T == view.targets[i].centre_T && decals_[i].radius_m == view.targets[i].radius_m;
  if (same) return;
  decals_.clear();
  for (const TargetMark& mark : view.targets) {
    const auto indices = triangles_near(organ_->mesh(), mark.centre_T, 1.9 * mark.radius_m);
    decals_.push_back({mark.centre_T, mark.radius_m, upload_indices(indices), static_cast<int>(indices.size())});
  }
}

void TissuePainter::draw_still_shadows() {
  for (auto* one : {&organ_, &second_})
    if (*one && !(*one)->moves()) (*one)->gpu().draw();
  for (const TissuePart& one : adjacent_)
    if (!one.moves()) one.gpu().draw();
}

void TissuePainter::draw_moving_shadows() {
  for (auto* one : {&organ_, &second_})
    if (*one && (*one)->moves()) (*one)->gpu().draw();
  for (const TissuePart& one : adjacent_)
    if (one.moves()) one.gpu().draw();
}

void TissuePainter::draw_part(TissuePart& part, const ProgramBinder& bind, const SceneView& view,
                              const ScopeOptics& optics) {
  if (!in_field(part.box(), view.camera, optics)) return;
  std::vector<std::string> defines;
  const bool is_organ = (organ_ && &part == &*organ_) || (second_ && &part == &*second_);
  if (is_organ && has_dimple(view)) defines.emplace_back("DIMPLED");
  if (part.moves()) defines.emplace_back("DEFORMED");
  defines.push_back(part.look);
  // The lining hangs on the wall, the fat on what lies under it: the organs breathe most. What gives way has moved.
  const double share = part.moves() || (wall_ && &part == &*wall_) ? 0.0 : fat_ && &part == &*fat_ ? 0.4 : 1.0;
  const auto draw = [&](const std::vector<std::string>& with) -> Program& {
    Program& program = bind("tissue", "tissue", with);
    set_vector(program.uniform("u_breath"), share * view.breath_T);
    return program;
  };
  draw(defines);
  part.gpu().draw();
  if (part.bears_marks()) {
    defines.emplace_back("MARKED");
    if (part.bears_fields()) defines.emplace_back("FIELDS");
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, mark_block_.id());
  }
  if (part.marked()) {
    draw(defines).bind_block("Marks", 1);
    part.draw_marked();
  }
  if (part.cut()) {
    defines.emplace_back("CUT");
    draw(defines).bind_block("Marks", 1);
    part.draw_cut();
  }
}

void TissuePainter::draw(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics) {
  for (TissuePart& one : adjacent_) draw_part(one, bind, view, optics);
  for (auto* one : {&organ_, &second_, &fat_, &wall_})
    if (*one) draw_part(**one, bind, view, optics);
  if (organ_) draw_decals(bind, view, optics);
}

void TissuePainter::draw_decals(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (std::size_t i = 0; i < decals_.size(); ++i) {
    const TargetMark& mark = view.targets[i];
    std::vector<std::string> defines;
    if (has_dimple(view)) defines.emplace_back("DIMPLED");
    if (organ_->moves()) defines.emplace_back("DEFORMED");
    defines.push_back(mark_look(mark.state));
    Program& program = bind("tissue", "decal", defines);
    const Vec3 normal = mark.normal_T.normalized();
    Vec3 across = optics.right() - normal * normal.dot(optics.right());
    across = across.norm() > 1e-6 ? Vec3(across.normalized()) : normal.unitOrthogonal();
    set_vector(program.uniform("u_breath"), (organ_->moves() ? 0.0 : 1.0) * view.breath_T);
    set_vector(program.uniform("u_mark"), mark.centre_T, mark.radius_m);
    set_vector(program.uniform("u_across"), across);
    set_vector(program.uniform("u_up"), normal.cross(across));
    set_vector(program.uniform("u_normal"), normal);
    organ_->gpu().draw_subset(decals_[i].indices, decals_[i].count);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace trocar
