#include "app/picture/scene/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "app/picture/display/hud_layout.h"
#include "app/picture/display/hud_painter.h"
#include "app/picture/gl/font.h"
#include "app/picture/gl/gl_objects.h"
#include "app/picture/gl/render_surfaces.h"
#include "app/picture/models/solid_noise.h"
#include "app/picture/scene/camera_pass.h"
#include "app/picture/scene/instrument_painter.h"
#include "app/picture/scene/object_painter.h"
#include "app/picture/scene/scene_block.h"
#include "app/picture/scene/tissue_painter.h"

namespace trocar {
namespace {

constexpr int kNoiseSize = 64;
enum TextureUnit { kNoiseUnit = 0, kShadowUnit = 1 };  // those of the camera follow, camera_pass.cpp

}  // namespace

struct Renderer::Impl {
  GraphicsContext& context;
  RenderOptions options;
  ShaderLibrary shaders;
  FontSet fonts;
  GlObject noise, scene_buffer, screen_array;
  RenderSurface shadow, still_shadow;  // of everything, and of the tissue alone that rests
  Eigen::Matrix4f still_for = Eigen::Matrix4f::Zero();
  int still_version = -1;
  CameraPass camera;
  InstrumentPainter instruments;
  ObjectPainter objects;
  TissuePainter tissue;
  TrainerBackdrop trainer;
  ProgramBinder binder;

  Impl(GraphicsContext& ctx, const std::filesystem::path& asset_root, const RenderOptions& opts);

  const PresetTraits& traits() const { return traits_of(options.preset); }
  void upload_noise();
  void draw(const SceneView& view, const PixelRect& window);
  Program& bind(const std::string& vertex, const std::string& fragment, std::vector<std::string> defines = {});
  void shadow_pass(const SceneView& view, const ScopeOptics& optics);
  void still_shadow_pass(Program& depth, const ScopeOptics& optics);
  void scene_pass(const SceneView& view, const ScopeOptics& optics);
  void read_back(Image& image, const PixelRect& window);
};

Renderer::Impl::Impl(GraphicsContext& ctx, const std::filesystem::path& asset_root, const RenderOptions& opts)
    : context(ctx), options(opts), shaders(asset_root) {
  context.make_current();
  upload_noise();
  scene_buffer = GlObject(GlObject::Kind::kBuffer);
  screen_array = GlObject(GlObject::Kind::kVertexArray);
  binder = [this](const std::string& vertex, const std::string& fragment,
                  std::vector<std::string> defines) -> Program& { return bind(vertex, fragment, std::move(defines)); };
}

void Renderer::Impl::upload_noise() {
  noise = GlObject(GlObject::Kind::kTexture);
  const std::vector<std::uint8_t> texels = solid_noise_texture(kNoiseSize);
  glBindTexture(GL_TEXTURE_3D, noise.id());
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, kNoiseSize, kNoiseSize, kNoiseSize, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               texels.data());
  glGenerateMipmap(GL_TEXTURE_3D);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, axis, GL_REPEAT);
}

Program& Renderer::Impl::bind(const std::string& vertex, const std::string& fragment,
                              std::vector<std::string> defines) {
  defines.push_back(traits().define);
  Program& program = shaders.program(vertex, fragment, defines);
  program.use();
  program.bind_block("Scene", 0);
  glUniform1i(program.uniform("u_noise"), kNoiseUnit);
  glUniform1i(program.uniform("u_shadow"), kShadowUnit);
  return program;
}

/// The shadow of tissue at rest is drawn anew only when the lamp or the meshes have changed; a resting scope pays for
/// it once.
void Renderer::Impl::still_shadow_pass(Program& depth, const ScopeOptics& optics) {
  if (still_for == optics.lamp_projection() && still_version == tissue.version()) return;
  still_for = optics.lamp_projection();
  still_version = tissue.version();
  still_shadow.begin();
  glClear(GL_DEPTH_BUFFER_BIT);
  const Eigen::Matrix4f here = Eigen::Matrix4f::Identity();
  glUniformMatrix4fv(depth.uniform("u_model"), 1, GL_FALSE, here.data());
  glCullFace(GL_FRONT);  // far sides cast: no self-shadow speckle on the lit side
  tissue.draw_still_shadows();
}

void Renderer::Impl::shadow_pass(const SceneView& view, const ScopeOptics& optics) {
  const int edge = traits().shadow_px;
  if (edge == 0) return;
  if (shadow.width != edge) {
    shadow = RenderSurface(RenderSurface::Use::kShadow, edge, edge);
    still_shadow = RenderSurface(RenderSurface::Use::kShadow, edge, edge);
    still_version = -1;
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  Program& program = bind("depth", "depth");
  still_shadow_pass(program, optics);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, still_shadow.framebuffer.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, shadow.framebuffer.id());
  glBlitFramebuffer(0, 0, edge, edge, 0, 0, edge, edge, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  shadow.begin();
  glCullFace(GL_BACK);
  instruments.draw_shadows(program, view);
  glCullFace(GL_FRONT);
  objects.draw_shadows(program, view);
  const Eigen::Matrix4f here = Eigen::Matrix4f::Identity();
  glUniformMatrix4fv(program.uniform("u_model"), 1, GL_FALSE, here.data());
  tissue.draw_moving_shadows();
  glCullFace(GL_BACK);
}

void Renderer::Impl::scene_pass(const SceneView& view, const ScopeOptics& optics) {
  const RenderSurface& scene = camera.scene();
  scene.begin();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  // Nothing outside the round field is ever seen.
  const int half = static_cast<int>(std::ceil(optics.circle_radius() / camera.picture().width * scene.width)) + 2;
  glEnable(GL_SCISSOR_TEST);
  glScissor(std::max(0, scene.width / 2 - half), 0, std::min(scene.width, 2 * half), scene.height);
  instruments.draw(binder, view);
  objects.draw_solids(binder, view);
  if (!tissue.empty())
    tissue.draw(binder, view, optics);
  else if (!view.stage_T.isEmpty())
    trainer.draw(binder, view.stage_T);
  objects.draw_ghosts(binder, view);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::read_back(Image& image, const PixelRect& window) {
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, window.width, window.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL error " + std::to_string(error) + " while drawing a frame");
  for (int y = 0; y < window.height; ++y) {
    const std::uint8_t* from =
        &rgba[static_cast<std::size_t>(window.height - 1 - y) * static_cast<std::size_t>(window.width) * 4];
    std::uint8_t* to = image.pixel(window.x, window.y + y);
    for (int x = 0; x < window.width; ++x, from += 4, to += 3) std::memcpy(to, from, 3);
  }
}

Renderer::Renderer(GraphicsContext& context, const std::filesystem::path& asset_root, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(context, asset_root, options)) {}

Renderer::~Renderer() {
  if (impl_) impl_->context.make_current();
}
Renderer::Renderer(Renderer&&) noexcept = default;

void Renderer::set_options(const RenderOptions& options) { impl_->options = options; }
const RenderOptions& Renderer::options() const { return impl_->options; }

/// All passes up to the finished picture of the scope.
void Renderer::Impl::draw(const SceneView& view, const PixelRect& window) {
  if (!view.camera.eye_T.allFinite() || !view.camera.look_at_T.allFinite() ||
      view.camera.eye_T == view.camera.look_at_T)
    throw std::invalid_argument("the scope's pose is not finite or looks at its own lens");
  context.make_current();
  const ScopeOptics optics(view.camera, window);
  camera.resize(window.width, window.height, traits().scale * options.scene_scale);
  tissue.prepare(view, traits());
  const SceneBlock block = make_scene_block(view, optics);
  glBindBuffer(GL_UNIFORM_BUFFER, scene_buffer.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, scene_buffer.id());
  glActiveTexture(GL_TEXTURE0 + kNoiseUnit);
  glBindTexture(GL_TEXTURE_3D, noise.id());
  shadow_pass(view, optics);
  if (traits().shadow_px > 0) {
    glActiveTexture(GL_TEXTURE0 + kShadowUnit);
    glBindTexture(GL_TEXTURE_2D, shadow.texture.id());
  }
  scene_pass(view, optics);
  camera.draw(binder, view, optics, window, options.grain, traits(), screen_array.id());
}

Image Renderer::render(const SceneView& view, int width, int height) {
  if (width < 320 || height < 240) throw std::invalid_argument("a picture needs at least 320 x 240 pixels");
  Impl& r = *impl_;
  const PixelRect window = hud_scene_window(view.hud, width, height, r.options.text_scale);
  r.draw(view, window);
  Image image(width, height);
  r.read_back(image, window);
  paint_hud(image, layout_hud(view.hud, width, height, r.options.text_scale, r.fonts), r.fonts);
  return image;
}

unsigned Renderer::draw_scope(const SceneView& view, int width, int height) {
  if (width < 64 || height < 48) throw std::invalid_argument("the scope's picture needs at least 64 x 48 pixels");
  impl_->draw(view, {0, 0, width, height});
  return impl_->camera.picture().texture.id();
}

void Renderer::finish() {
  impl_->context.make_current();
  glFinish();
}

}  // namespace trocar
