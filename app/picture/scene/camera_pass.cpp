#include "app/picture/scene/camera_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trocar {
namespace {

constexpr int kGlowDivisor = 6;
enum TextureUnit { kSceneUnit = 2, kGlowUnit = 3, kDepthUnit = 4, kVeilUnit = 5 };

float f(double value) { return static_cast<float>(value); }

void bind_texture(TextureUnit unit, const GlObject& texture) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture.id());
}

void set_camera_vector(int location, const Vec3& v, double w) {
  glUniform4f(location, f(v.x()), f(v.y()), f(v.z()), f(w));
}

}  // namespace

void CameraPass::resize(int width, int height, double scale) {
  const auto scaled = [&](int length) { return std::max(16, static_cast<int>(std::lround(length * scale))); };
  const int w = scaled(width), h = scaled(height);
  if (picture_.width == width && picture_.height == height && scene_.width == w && scene_.height == h) return;
  scene_ = RenderSurface(RenderSurface::Use::kSceneColour, w, h);
  for (RenderSurface* one : {&glow_, &veil_, &spare_})
    *one = RenderSurface(RenderSurface::Use::kGlow, std::max(1, w / kGlowDivisor), std::max(1, h / kGlowDivisor));
  small_ = w < width ? RenderSurface(RenderSurface::Use::kPicture, w, h) : RenderSurface();
  picture_ = RenderSurface(RenderSurface::Use::kPicture, width, height);
}

/// Scene at a sixth of its size, blurred. @param source "BRIGHT_PARTS" or "ALL_PARTS".
void CameraPass::blur(const ProgramBinder& bind, const RenderSurface& to, const RenderSurface& spare,
                      const char* source) {
  const auto pass = [&](const RenderSurface& target, const GlObject& from, Program& program) {
    target.begin();
    bind_texture(kSceneUnit, from);
    glUniform1i(program.uniform("u_scene"), kSceneUnit);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  };
  Program& reduce = bind("screen", "bright", {source});
  glUniform2f(reduce.uniform("u_texel"), 1.0F / f(scene_.width), 1.0F / f(scene_.height));
  pass(to, scene_.texture, reduce);
  Program& soften = bind("screen", "blur", {});
  glUniform2f(soften.uniform("u_step"), 1.0F / f(to.width), 0.0F);
  pass(spare, to.texture, soften);
  glUniform2f(soften.uniform("u_step"), 0.0F, 1.0F / f(to.height));
  pass(to, spare.texture, soften);
}

std::vector<std::string> CameraPass::lens_defines(const SceneView& view) const {
  std::vector<std::string> out;
  if (view.smoke_per_m > 0) out.emplace_back("WITH_SMOKE");
  if (view.lens.fog > 0) out.emplace_back("WITH_FOG");
  if (view.lens.blood > 0) out.emplace_back("WITH_LENS_BLOOD");
  return out;
}

void CameraPass::draw(const ProgramBinder& bind, const SceneView& view, const ScopeOptics& optics,
                      const PixelRect& window, bool grain, const PresetTraits& traits, unsigned screen) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(screen);
  std::vector<std::string> work = lens_defines(view);
  if (traits.glow) {
    blur(bind, glow_, spare_, "BRIGHT_PARTS");
    bind_texture(kGlowUnit, glow_.texture);
    work.emplace_back("WITH_GLOW");
  }
  if (view.lens.fog > 0 || view.lens.blood > 0) {
    blur(bind, veil_, spare_, "ALL_PARTS");
    bind_texture(kVeilUnit, veil_.texture);
  }
  bind_texture(kDepthUnit, scene_.depth);
  std::vector<std::string> finish;
  if (view.camera.level_rad) finish.emplace_back("WITH_LEVEL");
  if (grain) finish.emplace_back("WITH_GRAIN");
  if (scene_.width >= picture_.width) {
    work.insert(work.end(), finish.begin(), finish.end());
    return step(bind("screen", "post", work), view, optics, window, scene_, picture_);
  }
  work.emplace_back("SMALL");
  finish.emplace_back("UPSCALE");
  step(bind("screen", "post", work), view, optics, window, scene_, small_);
  step(bind("screen", "post", finish), view, optics, window, small_, picture_);
}

void CameraPass::step(Program& post, const SceneView& view, const ScopeOptics& optics, const PixelRect& window,
                      const RenderSurface& from, const RenderSurface& to) {
  to.begin();
  const double scale = static_cast<double>(to.width) / window.width;
  glUniform1i(post.uniform("u_scene"), kSceneUnit);
  glUniform1i(post.uniform("u_glow"), kGlowUnit);
  glUniform1i(post.uniform("u_depth"), kDepthUnit);
  glUniform1i(post.uniform("u_veil"), kVeilUnit);
  glUniform2f(post.uniform("u_size"), f(to.width), f(to.height));
  glUniform3f(post.uniform("u_circle"), f(scale * (optics.circle_x() - window.x)),
              f(scale * (window.y + window.height - optics.circle_y())), f(scale * optics.circle_radius()));
  glUniform2f(post.uniform("u_texel"), 1.0F / f(scene_.width), 1.0F / f(scene_.height));
  glUniform1f(post.uniform("u_barrel"), f(ScopeOptics::kBarrel));
  glUniform1f(post.uniform("u_frame"), f(std::fmod(std::floor(std::max(0.0, view.hud.elapsed_s) * 50), 65536.0)));
  glUniform2f(post.uniform("u_marks"), f(view.camera.notch_rad), f(view.camera.level_rad.value_or(0)));
  // Half extents of the undistorted picture at unit distance, for the way light takes through smoke.
  const double tan_half = std::tan(view.camera.diagonal_fov_deg * std::numbers::pi / 360);
  set_camera_vector(post.uniform("u_right"), tan_half * 0.5 * window.width / optics.circle_radius() * optics.right(),
                    view.smoke_per_m);
  set_camera_vector(post.uniform("u_up"), tan_half * 0.5 * window.height / optics.circle_radius() * optics.up(), 0);
  glUniform3f(post.uniform("u_lens"), f(std::clamp(view.lens.fog, 0.0, 1.0)), f(std::clamp(view.lens.blood, 0.0, 1.0)),
              f(std::clamp(view.lens.wipe, 0.0, 1.0)));
  bind_texture(kSceneUnit, from.texture);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace trocar
