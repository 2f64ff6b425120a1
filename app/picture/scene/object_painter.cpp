#include "app/picture/scene/object_painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "app/picture/models/solid_models.h"
#include "app/picture/scene/backdrop.h"

namespace trocar {
namespace {

constexpr std::size_t kObjectMeshesKept = 48;
constexpr std::size_t kCastersOnBoard = 12;  // as in object.frag

void set_object_vector(int location, const Vec3& v) {
  glUniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

void set_object_vector(int location, const Vec3& v, double w) {
  glUniform4f(location, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
              static_cast<float>(w));
}

/// Colour of a state: the same blue, yellow and green as the discs on tissue (decal.frag).
Vec3 state_colour(SceneObject::Style style) {
  switch (style) {
    case SceneObject::Style::kGhost:
      return {0.13, 0.50, 1.0};
    case SceneObject::Style::kGhostDone:
      return {0.0, 0.42, 0.22};
    default:
      return {1.0, 0.84, 0.03};
  }
}

std::vector<std::string> defines_of(const SceneObject& object) {
  std::vector<std::string> defines;
  switch (object.look) {
    case SceneObject::Look::kPlastic:
      defines.emplace_back("LOOK_PLASTIC");
      break;
    case SceneObject::Look::kFoam:
      defines.emplace_back("LOOK_FOAM");
      break;
    case SceneObject::Look::kSteel:
      defines.emplace_back("LOOK_STEEL");
      break;
    case SceneObject::Look::kBoard:
      defines.emplace_back("LOOK_BOARD");
      break;
  }
  if (object.style == SceneObject::Style::kLit) defines.emplace_back("LIT");
  if (object.pinch_depth_m > 0) defines.emplace_back("PINCHED");
  return defines;
}

std::string ghost_define(SceneObject::Style style) {
  if (style == SceneObject::Style::kGhostLit) return "GHOST_LIT";
  return style == SceneObject::Style::kGhostDone ? "GHOST_DONE" : "GHOST_WAITING";
}

/// What stands over a board and dims it: the solid objects and the instrument's tip.
void set_casters(Program& program, const SceneView& view) {
  std::size_t n = 0;
  const auto add = [&](const Vec3& centre, double radius) {
    if (n == kCastersOnBoard) return;
    set_object_vector(program.uniform("u_above[" + std::to_string(n++) + "]"), centre, radius);
  };
  add(view.X_TI.p, 1.4 * view.shaft_radius_m);
  for (const SceneObject& object : view.objects)
    if (!is_ghost(object) && object.shape != SceneObject::Shape::kBoard && object.shape != SceneObject::Shape::kRing &&
        object.shape != SceneObject::Shape::kSleeve)
      add(object.X_TO.p, 0.5 * std::max(object.size_m.x(), object.size_m.y()));
  glUniform1i(program.uniform("u_above_count"), static_cast<int>(n));
}

PictureMesh wire_mesh(const SurfaceSnapshot& surface, double wider_m) {
  PictureMesh mesh;
  const std::vector<Vec3> normals = TriangleSurface{surface.vertices, surface.triangles}.vertex_normals();
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const Eigen::Vector3f normal = normals[v].cast<float>();
    const Eigen::Vector3f place = (surface.vertices[v] + wider_m * normals[v]).cast<float>();
    mesh.vertices.push_back({{place.x(), place.y(), place.z()}, {normal.x(), normal.y(), normal.z()}, {1, 1}});
  }
  for (const auto& triangle : surface.triangles)
    for (const std::int32_t v : triangle) mesh.indices.push_back(static_cast<std::uint32_t>(v));
  return mesh;
}

}  // namespace

GpuMesh& ObjectPainter::mesh_of(const SceneObject& object) {
  const auto rounded = [](double metres) { return std::lround(metres * 1e7); };
  const std::array<long, 4> key = {static_cast<long>(object.shape), rounded(object.size_m.x()),
                                   rounded(object.size_m.y()), rounded(object.size_m.z())};
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  if (meshes_.size() >= kObjectMeshesKept) meshes_.clear();
  return meshes_.emplace(key, GpuMesh(build_solid(object.shape, object.size_m))).first->second;
}

void ObjectPainter::draw(Program& program, const SceneObject& object) {
  Eigen::Matrix4f model = Eigen::Matrix4f::Identity();
  model.topLeftCorner<3, 3>() = object.X_TO.R.cast<float>();
  model.topRightCorner<3, 1>() = object.X_TO.p.cast<float>();
  glUniformMatrix4fv(program.uniform("u_model"), 1, GL_FALSE, model.data());
  mesh_of(object).draw();
}

void ObjectPainter::draw_shadows(Program& depth, const SceneView& view) {
  for (const SceneObject& object : view.objects)
    if (!is_ghost(object)) draw(depth, object);
  for (const WireView& wire : view.wires) draw_wire(depth, wire);
}

/// Few vertices, elsewhere in every picture: nothing is kept.
void ObjectPainter::draw_wire(Program& program, const WireView& wire) {
  const Eigen::Matrix4f model = Eigen::Matrix4f::Identity();
  glUniformMatrix4fv(program.uniform("u_model"), 1, GL_FALSE, model.data());
  GpuMesh(wire_mesh(*wire.surface, wire.wider_m)).draw();
}

void ObjectPainter::draw_solids(const ProgramBinder& bind, const SceneView& view) {
  for (const SceneObject& object : view.objects) {
    if (is_ghost(object)) continue;
    Program& program = bind("object", "object", defines_of(object));
    set_object_vector(program.uniform("u_colour"), object.colour);
    set_object_vector(program.uniform("u_accent"), object.accent);
    set_object_vector(program.uniform("u_half"), 0.5 * object.size_m);
    set_object_vector(program.uniform("u_pinch"), object.pinch_O, object.pinch_depth_m);
    glUniform1f(program.uniform("u_bands"), static_cast<float>(object.bands));
    glUniform1f(program.uniform("u_wear"), static_cast<float>(std::clamp(object.wear, 0.0, 1.0)));
    if (object.look == SceneObject::Look::kBoard) set_casters(program, view);
    draw(program, object);
  }
  for (const WireView& wire : view.wires) {
    SceneObject looks_so;
    looks_so.look = wire.look;
    Program& program = bind("object", "object", defines_of(looks_so));
    set_object_vector(program.uniform("u_colour"), wire.colour);
    set_object_vector(program.uniform("u_accent"), wire.colour);
    glUniform1f(program.uniform("u_wear"), 0);
    draw_wire(program, wire);
  }
}

void ObjectPainter::draw_ghosts(const ProgramBinder& bind, const SceneView& view) {
  std::vector<const SceneObject*> ghosts;
  for (const SceneObject& object : view.objects)
    if (is_ghost(object)) ghosts.push_back(&object);
  const auto distance = [&](const SceneObject* object) { return (object->X_TO.p - view.camera.eye_T).norm(); };
  std::stable_sort(ghosts.begin(), ghosts.end(),
                   [&](const SceneObject* a, const SceneObject* b) { return distance(a) > distance(b); });
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (const SceneObject* object : ghosts) {
    Program& program = bind("object", "ghost", {ghost_define(object->style)});
    set_object_vector(program.uniform("u_colour"), state_colour(object->style));
    draw(program, *object);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void TrainerBackdrop::draw(const ProgramBinder& bind, const Eigen::AlignedBox3d& stage_T) {
  if (built_for_.isEmpty() || built_for_.min() != stage_T.min() || built_for_.max() != stage_T.max()) {
    mesh_ = GpuMesh(build_trainer_box(stage_T));
    built_for_ = stage_T;
  }
  bind("tissue", "drape", {});
  mesh_.draw();
}

}  // namespace trocar
