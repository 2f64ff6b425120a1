#include "app/picture/attempt/attempt_picture.h"

#include <cstdio>

#include "app/picture/attempt/attempt_hud.h"
#include "app/picture/attempt/attempt_scene.h"
#include "app/picture/gl/headless_context.h"
#include "app/picture/scene/renderer.h"
#include "haptics/input_error.h"

namespace trocar {

SceneView attempt_view(const SessionView& view, const std::string& trainee, const std::optional<Camera>& seen) {
  SceneView out = attempt_scene(view);
  if (seen) out.camera = *seen;
  out.hud = attempt_hud(view, out.camera, trainee);
  return out;
}

namespace {

RenderOptions with(Preset preset) {
  RenderOptions options;
  options.preset = preset;
  return options;
}

}  // namespace

struct AttemptPainter::Impl {
  Impl(const AssetRoots& assets, std::string trainee_in, int width_in, int height_in, Preset preset)
      : renderer(context, assets.assets, with(preset)),
        trainee(std::move(trainee_in)),
        width(width_in),
        height(height_in) {}

  HeadlessContext context;
  Renderer renderer;
  std::string trainee;
  int width, height;
};

AttemptPainter::AttemptPainter(const AssetRoots& assets, std::string trainee, int width, int height, Preset preset)
    : impl_(std::make_unique<Impl>(assets, std::move(trainee), width, height, preset)) {}
AttemptPainter::~AttemptPainter() = default;

Image AttemptPainter::paint(const SessionView& view) { return paint(scene(view)); }
SceneView AttemptPainter::scene(const SessionView& view) const { return attempt_view(view, impl_->trainee); }
Image AttemptPainter::paint(const SceneView& view) { return impl_->renderer.render(view, impl_->width, impl_->height); }

PictureSink numbered_pictures(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw EnvironmentError(directory.string() + ": cannot be made: " + error.message());
  return [directory, number = 0](const Image& image) mutable {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%05d.png", ++number);
    write_png(directory / name, image);
  };
}

FrameWriter::FrameWriter(AttemptPainter& painter, PictureSink sink, double fps)
    : painter_(painter), sink_(std::move(sink)), period_s_(1 / fps) {}

FrameWriter::FrameWriter(AttemptPainter& painter, const std::filesystem::path& directory, double fps)
    : FrameWriter(painter, numbered_pictures(directory), fps) {}

void FrameWriter::observe(const SessionView& view) {
  if (view.t_s + 1e-9 < next_s_) return;
  const Image image = painter_.paint(view);
  while (view.t_s + 1e-9 >= next_s_) {
    sink_(image);
    next_s_ = ++written_ * period_s_;
  }
}

}  // namespace trocar
