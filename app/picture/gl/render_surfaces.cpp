#include "app/picture/gl/render_surfaces.h"

#include <epoxy/gl.h>

#include "haptics/input_error.h"

namespace trocar {
namespace {

struct Format {
  GLint internal;
  GLenum external, type;
};

void allocate(const GlObject& texture, const Format& format, int width, int height, GLint filter) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, format.internal, width, height, 0, format.external, format.type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

constexpr Format kColour = {GL_R11F_G11F_B10F, GL_RGB, GL_FLOAT};
constexpr Format kDepth = {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
constexpr Format kPictureFormat = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

}  // namespace

RenderSurface::RenderSurface(Use use, int w, int h)
    : framebuffer(GlObject::Kind::kFramebuffer), texture(GlObject::Kind::kTexture), width(w), height(h) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  if (use == Use::kShadow) {
    allocate(texture, kDepth, w, h, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  } else {
    allocate(texture, use == Use::kPicture ? kPictureFormat : kColour, w, h, GL_LINEAR);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  }
  if (use == Use::kSceneColour) {
    depth = GlObject(GlObject::Kind::kTexture);
    allocate(depth, kDepth, w, h, GL_NEAREST);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth.id(), 0);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw EnvironmentError("no picture: the graphics driver refuses a framebuffer that OpenGL 3.3 requires");
}

void RenderSurface::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glViewport(0, 0, width, height);
}

}  // namespace trocar
