#include "app/graphics/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "app/graphics/backdrop.h"
#include "app/graphics/font.h"
#include "app/graphics/gl_objects.h"
#include "app/graphics/hud_layout.h"
#include "app/graphics/hud_painter.h"
#include "app/graphics/instrument_model.h"
#include "app/graphics/object_painter.h"
#include "app/graphics/render_surfaces.h"
#include "app/graphics/scene_block.h"
#include "app/graphics/solid_noise.h"
#include "app/graphics/tissue_painter.h"

namespace trocar {
namespace {

constexpr int kNoiseSize = 64, kShadowSize = 768, kGlowDivisor = 6;
enum TextureUnit { kNoiseUnit = 0, kShadowUnit = 1, kSceneUnit = 2, kGlowUnit = 3 };

/// The gallbladder lies on the liver; everything else on fat.
std::string bed_look(const std::string& material) { return material == "gallbladder" ? "LOOK_LIVER" : "LOOK_FAT"; }

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

Eigen::Matrix4f matrix(const Pose& X) {
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.topLeftCorner<3, 3>() = X.R.cast<float>();
  m.topRightCorner<3, 1>() = X.p.cast<float>();
  return m;
}

void set_vector(int location, const Vec3& v) {
  glUniform3f(location, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

/// Box of the organ and what lies round it: the lining of the abdomen lies outside of all.
Eigen::AlignedBox3d tissue_bounds(const SceneView& view) {
  Eigen::AlignedBox3d box = view.organ->bounds();
  for (const NeighbourView& neighbour : view.neighbours) box.extend(neighbour.surface->bounds());
  return box;
}

/// Everything about one organ that is worth keeping between frames.
struct OrganOnGpu {
  std::weak_ptr<const TriangleSurface> source;
  PictureMesh mesh;
  GpuMesh gpu, cavity, fat;
};

struct Decal {
  Vec3 centre_T;
  double radius_m;
  GlObject indices;
  int count;
};

}  // namespace

struct Renderer::Impl {
  GraphicsContext& context;
  RenderOptions options;
  ShaderLibrary shaders;
  FontSet fonts;
  GlObject noise, scene_buffer, screen_array;
  RenderSurface scene, glow_a, glow_b, shadow, small, picture;
  std::optional<OrganOnGpu> organ;
  std::vector<Decal> decals;
  GpuMesh shaft, jaw;
  ObjectPainter objects;
  TissuePainter neighbours;
  TrainerBackdrop trainer;
  double shaft_radius_m = 0, shaft_length_m = 0;

  Impl(GraphicsContext& ctx, const std::filesystem::path& asset_root, const RenderOptions& opts);

  void draw(const SceneView& view, const PixelRect& window);
  void ensure_surfaces(int width, int height);
  void ensure_organ(const SceneView& view);
  void ensure_decals(const SceneView& view);
  void ensure_instrument(const SceneView& view);
  Program& bind(const std::string& vertex, const std::string& fragment, std::vector<std::string> defines = {});
  void draw_instrument_parts(Program& program, const SceneView& view);
  void shadow_pass(const SceneView& view);
  void scene_pass(const SceneView& view, const ScopeOptics& optics);
  void tissue_pass(const SceneView& view, const ScopeOptics& optics);
  void decal_pass(const SceneView& view, const ScopeOptics& optics, const std::vector<std::string>& dimple);
  void glow_pass();
  void post_pass(const SceneView& view, const ScopeOptics& optics, const PixelRect& window);
  struct PostStep {
    const RenderSurface &from, &to;
  };
  void post_step(const SceneView& view, const ScopeOptics& optics, const PixelRect& window, const PostStep& step,
                 const std::vector<std::string>& defines);
  void read_back(Image& image, const PixelRect& window);
};

Renderer::Impl::Impl(GraphicsContext& ctx, const std::filesystem::path& asset_root, const RenderOptions& opts)
    : context(ctx), options(opts), shaders(asset_root) {
  context.make_current();
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
  scene_buffer = GlObject(GlObject::Kind::kBuffer);
  screen_array = GlObject(GlObject::Kind::kVertexArray);
  shadow = RenderSurface(RenderSurface::Use::kShadow, kShadowSize, kShadowSize);
}

void Renderer::Impl::ensure_surfaces(int width, int height) {
  if (picture.width == width && picture.height == height) return;
  const auto scaled = [&](int length) {
    return std::max(16, static_cast<int>(std::lround(length * options.scene_scale)));
  };
  const int w = scaled(width), h = scaled(height);
  scene = RenderSurface(RenderSurface::Use::kSceneColour, w, h);
  glow_a = RenderSurface(RenderSurface::Use::kGlow, std::max(1, w / kGlowDivisor), std::max(1, h / kGlowDivisor));
  glow_b = RenderSurface(RenderSurface::Use::kGlow, glow_a.width, glow_a.height);
  small = w < width ? RenderSurface(RenderSurface::Use::kPicture, w, h) : RenderSurface();
  picture = RenderSurface(RenderSurface::Use::kPicture, width, height);
}

void Renderer::Impl::ensure_organ(const SceneView& view) {
  if (!view.organ || view.organ->triangles.empty()) {
    organ.reset();
    decals.clear();
    return;
  }
  if (organ && organ->source.lock() == view.organ) return;
  decals.clear();
  OrganOnGpu fresh;
  fresh.source = view.organ;
  fresh.mesh = build_picture_mesh(*view.organ);
  fresh.gpu = GpuMesh(fresh.mesh);
  const Eigen::AlignedBox3d bounds = tissue_bounds(view);
  fresh.cavity = GpuMesh(build_cavity(bounds));
  fresh.fat = GpuMesh(build_fat_bed(bounds));
  organ.emplace(std::move(fresh));
}

void Renderer::Impl::ensure_decals(const SceneView& view) {
  if (!organ) return;
  bool same = decals.size() == view.targets.size();
  for (std::size_t i = 0; same && i < decals.size(); ++i)
    same = decals[i].centre_T == view.targets[i].centre_T && decals[i].radius_m == view.targets[i].radius_m;
  if (same) return;
  decals.clear();
  for (const TargetMark& mark : view.targets) {
    const auto indices = triangles_near(organ->mesh, mark.centre_T, 1.9 * mark.radius_m);
    decals.push_back({mark.centre_T, mark.radius_m, upload_indices(indices), static_cast<int>(indices.size())});
  }
}

void Renderer::Impl::ensure_instrument(const SceneView& view) {
  if (shaft_radius_m == view.shaft_radius_m && shaft_length_m == view.shaft_length_m) return;
  shaft_radius_m = view.shaft_radius_m;
  shaft_length_m = view.shaft_length_m;
  shaft = GpuMesh(build_shaft(shaft_radius_m, shaft_length_m));
  jaw = GpuMesh(build_jaw(shaft_radius_m));
}

Program& Renderer::Impl::bind(const std::string& vertex, const std::string& fragment,
                              std::vector<std::string> defines) {
  Program& program = shaders.program(vertex, fragment, defines);
  program.use();
  program.bind_block("Scene", 0);
  glUniform1i(program.uniform("u_noise"), kNoiseUnit);
  glUniform1i(program.uniform("u_shadow"), kShadowUnit);
  return program;
}

void Renderer::Impl::draw_instrument_parts(Program& program, const SceneView& view) {
  const int model = program.uniform("u_model");
  const auto place = [&](const Pose& X) { glUniformMatrix4fv(model, 1, GL_FALSE, matrix(X).data()); };
  place(view.X_TI);
  shaft.draw();
  for (const int side : {1, -1}) {
    place(view.X_TI * jaw_pose(side, view.jaw_opening_m));
    jaw.draw();
  }
}

void Renderer::Impl::shadow_pass(const SceneView& view) {
  shadow.begin();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glClear(GL_DEPTH_BUFFER_BIT);
  Program& program = bind("depth", "depth");
  draw_instrument_parts(program, view);
  glUniformMatrix4fv(program.uniform("u_model"), 1, GL_FALSE, matrix(Pose{}).data());
  glCullFace(GL_FRONT);  // far sides cast: no self-shadow speckle on the lit side
  if (organ) organ->gpu.draw();
  neighbours.draw_shadows();
  objects.draw_shadows(program, view.objects);
  glCullFace(GL_BACK);
}

void Renderer::Impl::scene_pass(const SceneView& view, const ScopeOptics& optics) {
  scene.begin();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  // Nothing outside the round field is ever seen.
  const int half = static_cast<int>(std::ceil(optics.circle_radius() / picture.width * scene.width)) + 2;
  glEnable(GL_SCISSOR_TEST);
  glScissor(std::max(0, scene.width / 2 - half), 0, std::min(scene.width, 2 * half), scene.height);
  draw_instrument_parts(bind("instrument", "instrument",
                             view.roll_stripe ? std::vector<std::string>{"ROLL_STRIPE"} : std::vector<std::string>{}),
                        view);
  const ProgramBinder binder = [this](const std::string& vertex, const std::string& fragment,
                                      std::vector<std::string> defines) -> Program& {
    return bind(vertex, fragment, std::move(defines));
  };
  objects.draw_solids(binder, view);
  neighbours.draw(binder);
  if (organ)
    tissue_pass(view, optics);
  else if (!view.stage_T.isEmpty())
    trainer.draw(binder, view.stage_T);
  objects.draw_ghosts(binder, view);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::tissue_pass(const SceneView& view, const ScopeOptics& optics) {
  const std::vector<std::string> dimple =
      has_dimple(view) ? std::vector<std::string>{"DIMPLED"} : std::vector<std::string>{};
  std::vector<std::string> defines = dimple;
  defines.push_back(tissue_look(view.material));
  bind("tissue", "tissue", defines);
  organ->gpu.draw();
  bind("tissue", "tissue", {bed_look(view.material)});
  organ->fat.draw();
  bind("tissue", "tissue", {"LOOK_WALL"});
  organ->cavity.draw();
  decal_pass(view, optics, dimple);
}

void Renderer::Impl::decal_pass(const SceneView& view, const ScopeOptics& optics,
                                const std::vector<std::string>& dimple) {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (std::size_t i = 0; i < decals.size(); ++i) {
    const TargetMark& mark = view.targets[i];
    std::vector<std::string> defines = dimple;
    defines.push_back(mark_look(mark.state));
    Program& program = bind("tissue", "decal", defines);
    const Vec3 normal = mark.normal_T.normalized();
    Vec3 across = optics.right() - normal * normal.dot(optics.right());
    across = across.norm() > 1e-6 ? Vec3(across.normalized()) : normal.unitOrthogonal();
    glUniform4f(program.uniform("u_mark"), static_cast<float>(mark.centre_T.x()), static_cast<float>(mark.centre_T.y()),
                static_cast<float>(mark.centre_T.z()), static_cast<float>(mark.radius_m));
    set_vector(program.uniform("u_across"), across);
    set_vector(program.uniform("u_up"), normal.cross(across));
    set_vector(program.uniform("u_normal"), normal);
    organ->gpu.draw_subset(decals[i].indices, decals[i].count);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Renderer::Impl::glow_pass() {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(screen_array.id());
  glActiveTexture(GL_TEXTURE0 + kSceneUnit);
  const auto draw = [&](const RenderSurface& to, const GlObject& from, Program& program) {
    to.begin();
    glBindTexture(GL_TEXTURE_2D, from.id());
    glUniform1i(program.uniform("u_scene"), kSceneUnit);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  };
  Program& bright = bind("screen", "bright");
  glUniform2f(bright.uniform("u_texel"), 1.0F / static_cast<float>(scene.width),
              1.0F / static_cast<float>(scene.height));
  draw(glow_a, scene.texture, bright);
  Program& blur = bind("screen", "blur");
  glUniform2f(blur.uniform("u_step"), 1.0F / static_cast<float>(glow_a.width), 0.0F);
  draw(glow_b, glow_a.texture, blur);
  glUniform2f(blur.uniform("u_step"), 0.0F, 1.0F / static_cast<float>(glow_a.height));
  draw(glow_a, glow_b.texture, blur);
}

void Renderer::Impl::post_pass(const SceneView& view, const ScopeOptics& optics, const PixelRect& window) {
  glActiveTexture(GL_TEXTURE0 + kGlowUnit);
  glBindTexture(GL_TEXTURE_2D, glow_a.texture.id());
  const std::string grain = options.grain ? "WITH_GRAIN" : "WITHOUT_GRAIN";
  if (scene.width >= picture.width) return post_step(view, optics, window, {scene, picture}, {grain});
  post_step(view, optics, window, {scene, small}, {"SMALL"});
  post_step(view, optics, window, {small, picture}, {"UPSCALE", grain});
}

void Renderer::Impl::post_step(const SceneView& view, const ScopeOptics& optics, const PixelRect& window,
                               const PostStep& step, const std::vector<std::string>& defines) {
  step.to.begin();
  Program& post = bind("screen", "post", defines);
  const auto f = [](double value) { return static_cast<float>(value); };
  const double scale = static_cast<double>(step.to.width) / window.width;
  glUniform1i(post.uniform("u_scene"), kSceneUnit);
  glUniform1i(post.uniform("u_glow"), kGlowUnit);
  glUniform2f(post.uniform("u_size"), f(step.to.width), f(step.to.height));
  glUniform3f(post.uniform("u_circle"), f(scale * (optics.circle_x() - window.x)),
              f(scale * (window.y + window.height - optics.circle_y())), f(scale * optics.circle_radius()));
  glUniform2f(post.uniform("u_texel"), 1.0F / f(scene.width), 1.0F / f(scene.height));
  glUniform1f(post.uniform("u_barrel"), f(ScopeOptics::kBarrel));
  glUniform1f(post.uniform("u_frame"), f(std::fmod(std::floor(std::max(0.0, view.hud.elapsed_s) * 50), 65536.0)));
  glActiveTexture(GL_TEXTURE0 + kSceneUnit);
  glBindTexture(GL_TEXTURE_2D, step.from.texture.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
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

/// All passes up to the finished picture of the scope.
void Renderer::Impl::draw(const SceneView& view, const PixelRect& window) {
  if (!view.camera.eye_T.allFinite() || !view.camera.look_at_T.allFinite() ||
      view.camera.eye_T == view.camera.look_at_T)
    throw std::invalid_argument("the scope's pose is not finite or looks at its own lens");
  context.make_current();
  const ScopeOptics optics(view.camera, window);
  ensure_surfaces(window.width, window.height);
  ensure_organ(view);
  neighbours.prepare(view.neighbours);
  ensure_decals(view);
  ensure_instrument(view);
  const SceneBlock block = make_scene_block(view, optics);
  glBindBuffer(GL_UNIFORM_BUFFER, scene_buffer.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, scene_buffer.id());
  glActiveTexture(GL_TEXTURE0 + kNoiseUnit);
  glBindTexture(GL_TEXTURE_3D, noise.id());
  shadow_pass(view);
  glActiveTexture(GL_TEXTURE0 + kShadowUnit);
  glBindTexture(GL_TEXTURE_2D, shadow.texture.id());
  scene_pass(view, optics);
  glow_pass();
  post_pass(view, optics, window);
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
  return impl_->picture.texture.id();
}

}  // namespace trocar
