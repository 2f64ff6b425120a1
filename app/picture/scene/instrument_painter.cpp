#include "app/picture/scene/instrument_painter.h"

#include <epoxy/gl.h>

#include <cmath>

#include "app/picture/models/instrument_model.h"

namespace trocar {
namespace {

constexpr std::size_t kMeshesKept = 8;

Eigen::Matrix4f matrix(const Pose& X) {
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.topLeftCorner<3, 3>() = X.R.cast<float>();
  m.topRightCorner<3, 1>() = X.p.cast<float>();
  return m;
}

}  // namespace

std::vector<InstrumentView> instruments_of(const SceneView& view) {
  std::vector<InstrumentView> all = {
      {view.X_TI, view.shaft_radius_m, view.shaft_length_m, view.jaw_opening_m, view.roll_stripe, view.instrument}};
  all.insert(all.end(), view.more_instruments.begin(), view.more_instruments.end());
  return all;
}

void InstrumentPainter::draw_parts(Program& program, const InstrumentView& instrument) {
  const std::array<long, 3> key = {static_cast<long>(instrument.kind), std::lround(instrument.shaft_radius_m * 1e7),
                                   std::lround(instrument.shaft_length_m * 1e7)};
  auto found = meshes_.find(key);
  if (found == meshes_.end()) {
    if (meshes_.size() >= kMeshesKept) meshes_.clear();
    found =
        meshes_
            .emplace(key,
                     Meshes{GpuMesh(build_body(instrument.kind, instrument.shaft_radius_m, instrument.shaft_length_m)),
                            GpuMesh(build_jaw(instrument.kind, instrument.shaft_radius_m))})
            .first;
  }
  const int model = program.uniform("u_model");
  const auto place = [&](const Pose& X) { glUniformMatrix4fv(model, 1, GL_FALSE, matrix(X).data()); };
  place(instrument.X_TI);
  found->second.body.draw();
  const double jaw_length_m = drawn_jaw_length_m(instrument.kind);
  if (jaw_length_m <= 0) return;
  for (const int side : {1, -1}) {
    place(instrument.X_TI * jaw_pose(side, instrument.jaw_opening_m, jaw_length_m));
    found->second.jaw.draw();
  }
}

void InstrumentPainter::draw_shadows(Program& depth, const SceneView& view) {
  for (const InstrumentView& instrument : instruments_of(view)) draw_parts(depth, instrument);
}

void InstrumentPainter::draw(const ProgramBinder& bind, const SceneView& view) {
  for (const InstrumentView& instrument : instruments_of(view)) {
    std::vector<std::string> defines;
    if (!view.organ) defines.emplace_back("IN_BOX");
    if (instrument.roll_stripe) defines.emplace_back("ROLL_STRIPE");
    draw_parts(bind("instrument", "instrument", defines), instrument);
  }
}

}  // namespace trocar
