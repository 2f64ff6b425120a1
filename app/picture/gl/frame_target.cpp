#include "app/picture/gl/frame_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "app/picture/gl/gl_objects.h"
#include "app/picture/gl/render_surfaces.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

constexpr const char* kVertex = R"(#version 330 core
out vec2 v_uv;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1);
  v_uv = corner * 0.5 + 0.5;
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";
constexpr const char* kFragment = R"(#version 330 core
in vec2 v_uv;
uniform sampler2D u_picture;
uniform float u_light;
out vec4 colour;
void main() { colour = vec4(texture(u_picture, v_uv).rgb * u_light, 1.0); }
)";

GlObject compile(unsigned stage, const char* text) {
  GlObject shader(GlObject::Kind::kShader, stage);
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint ok = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (!ok) throw EnvironmentError("no picture: the graphics driver refuses a shader that OpenGL 3.3 requires");
  return shader;
}

GlObject placing_program() {
  const GlObject vertex = compile(GL_VERTEX_SHADER, kVertex), fragment = compile(GL_FRAGMENT_SHADER, kFragment);
  GlObject program(GlObject::Kind::kProgram);
  glAttachShader(program.id(), vertex.id());
  glAttachShader(program.id(), fragment.id());
  glLinkProgram(program.id());
  GLint ok = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
  if (!ok) throw EnvironmentError("no picture: the graphics driver cannot link a shader");
  return program;
}

}  // namespace

struct FrameTarget::State {
  GraphicsContext& context;
  bool to_window;
  GlObject program, array;
  std::optional<RenderSurface> surface;
  int width = 0, height = 0;

  State(GraphicsContext& graphics, bool window)
      : context(graphics), to_window(window), program(placing_program()), array(GlObject::Kind::kVertexArray) {}
  unsigned framebuffer() const { return surface ? surface->framebuffer.id() : 0U; }
};

FrameTarget::FrameTarget(GraphicsContext& context, bool to_window) {
  context.make_current();
  state_ = std::make_unique<State>(context, to_window);
}

FrameTarget::~FrameTarget() {
  try {
    state_->context.make_current();
  } catch (const EnvironmentError&) {
    // Held by another thread or gone: its objects go with it.
  }
}

void FrameTarget::begin(int width, int height) {
  if (width < 64 || height < 48) throw std::invalid_argument("a frame needs at least 64 x 48 pixels");
  State& s = *state_;
  s.context.make_current();
  if (!s.to_window && (!s.surface || s.surface->width != width || s.surface->height != height))
    s.surface.emplace(RenderSurface::Use::kPicture, width, height);
  s.width = width;
  s.height = height;
  glBindFramebuffer(GL_FRAMEBUFFER, s.framebuffer());
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void FrameTarget::place(unsigned texture, const PixelRect& part, double dim) {
  const State& s = *state_;
  if (s.width == 0) throw std::logic_error("begin() comes before place()");
  glBindFramebuffer(GL_FRAMEBUFFER, s.framebuffer());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glViewport(part.x, s.height - part.y - part.height, part.width, part.height);
  glUseProgram(s.program.id());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  glUniform1i(glGetUniformLocation(s.program.id(), "u_picture"), 0);
  glUniform1f(glGetUniformLocation(s.program.id(), "u_light"), static_cast<float>(1 - std::clamp(dim, 0.0, 1.0)));
  glBindVertexArray(s.array.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glViewport(0, 0, s.width, s.height);
}

Image FrameTarget::read() const {
  const State& s = *state_;
  if (s.width == 0) throw std::logic_error("begin() comes before read()");
  s.context.make_current();
  glBindFramebuffer(GL_FRAMEBUFFER, s.framebuffer());
  const auto row = static_cast<std::size_t>(s.width) * 4;
  std::vector<std::uint8_t> rgba(row * static_cast<std::size_t>(s.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, s.width, s.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw EnvironmentError("OpenGL error " + std::to_string(error) + " while reading a frame back");
  Image image(s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    const std::uint8_t* from = &rgba[static_cast<std::size_t>(s.height - 1 - y) * row];
    std::uint8_t* to = image.pixel(0, y);
    for (int x = 0; x < s.width; ++x, from += 4, to += 3) std::memcpy(to, from, 3);
  }
  return image;
}

}  // namespace trocar
