#include "app/picture/gl/gl_objects.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <fstream>
#include <sstream>

#include "haptics/input_error.h"

namespace trocar {
namespace {

/// Of the bound array, read from the bound buffer of PictureVertex.
void vertex_attribute(GLuint index, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(PictureVertex), reinterpret_cast<const void*>(offset));
}

}  // namespace

GlObject::GlObject(Kind kind, unsigned shader_stage) : kind_(kind) {
  switch (kind) {
    case Kind::kNone:
      break;
    case Kind::kBuffer:
      glGenBuffers(1, &id_);
      break;
    case Kind::kVertexArray:
      glGenVertexArrays(1, &id_);
      break;
    case Kind::kTexture:
      glGenTextures(1, &id_);
      break;
    case Kind::kFramebuffer:
      glGenFramebuffers(1, &id_);
      break;
    case Kind::kProgram:
      id_ = glCreateProgram();
      break;
    case Kind::kShader:
      id_ = glCreateShader(shader_stage);
      break;
  }
}

GlObject& GlObject::operator=(GlObject&& other) noexcept {
  if (this != &other) {
    reset();
    kind_ = other.kind_;
    id_ = std::exchange(other.id_, 0U);
  }
  return *this;
}

void GlObject::reset() {
  if (id_ == 0) return;
  switch (kind_) {
    case Kind::kNone:
      break;
    case Kind::kBuffer:
      glDeleteBuffers(1, &id_);
      break;
    case Kind::kVertexArray:
      glDeleteVertexArrays(1, &id_);
      break;
    case Kind::kTexture:
      glDeleteTextures(1, &id_);
      break;
    case Kind::kFramebuffer:
      glDeleteFramebuffers(1, &id_);
      break;
    case Kind::kProgram:
      glDeleteProgram(id_);
      break;
    case Kind::kShader:
      glDeleteShader(id_);
      break;
  }
  id_ = 0;
}

GlObject upload_indices(const std::vector<std::uint32_t>& indices) {
  GlObject buffer(GlObject::Kind::kBuffer);
  glBindVertexArray(0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
               GL_STATIC_DRAW);
  return buffer;
}

GpuMesh::GpuMesh(const PictureMesh& mesh)
    : array_(GlObject::Kind::kVertexArray),
      vertices_(GlObject::Kind::kBuffer),
      indices_(upload_indices(mesh.indices)),
      count_(static_cast<int>(mesh.indices.size())) {
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(PictureVertex)),
               mesh.vertices.data(), GL_STATIC_DRAW);
  vertex_attribute(0, 3, offsetof(PictureVertex, position));
  vertex_attribute(1, 3, offsetof(PictureVertex, normal));
  vertex_attribute(2, 2, offsetof(PictureVertex, light));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBindVertexArray(0);
}

void GpuMesh::move(const std::vector<PictureVertex>& vertices) {
  glBindVertexArray(array_.id());
  const bool first = moved_.id() == 0;
  if (first) {
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    vertex_attribute(3, 3, offsetof(PictureVertex, position));
    vertex_attribute(4, 3, offsetof(PictureVertex, normal));
    moved_ = GlObject(GlObject::Kind::kBuffer);
  }
  glBindBuffer(GL_ARRAY_BUFFER, moved_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(PictureVertex)), vertices.data(),
               GL_STREAM_DRAW);
  if (first) {
    vertex_attribute(0, 3, offsetof(PictureVertex, position));
    vertex_attribute(1, 3, offsetof(PictureVertex, normal));
    vertex_attribute(2, 2, offsetof(PictureVertex, light));
  }
  glBindVertexArray(0);
}

void GpuMesh::set_fields(const std::vector<std::array<std::uint8_t, 4>>& fields) {
  glBindVertexArray(array_.id());
  if (fields_.id() == 0) fields_ = GlObject(GlObject::Kind::kBuffer);
  glBindBuffer(GL_ARRAY_BUFFER, fields_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(fields.size() * sizeof fields[0]), fields.data(),
               GL_STREAM_DRAW);
  glEnableVertexAttribArray(5);
  glVertexAttribPointer(5, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
  glBindVertexArray(0);
}

void GpuMesh::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

void GpuMesh::draw_subset(const GlObject& indices, int count) const {
  if (count == 0) return;
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
  glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, nullptr);
}

void Program::use() const { glUseProgram(object_.id()); }

int Program::uniform(const std::string& name) {
  const auto [place, inserted] = locations_.try_emplace(name, -1);
  if (inserted) place->second = glGetUniformLocation(object_.id(), name.c_str());
  return place->second;
}

void Program::bind_block(const std::string& name, unsigned binding) const {
  const GLuint index = glGetUniformBlockIndex(object_.id(), name.c_str());
  if (index != GL_INVALID_INDEX) glUniformBlockBinding(object_.id(), index, binding);
}

std::string ShaderLibrary::read(const std::string& file) const {
  std::ifstream stream(folder_ / file);
  if (!stream)
    throw EnvironmentError("cannot read shader " + (folder_ / file).string() + ": the installation is incomplete");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

GlObject ShaderLibrary::compile(const std::string& file, unsigned stage,
                                const std::vector<std::string>& defines) const {
  std::string source = "#version 330 core\n";
  for (const std::string& define : defines) source += "#define " + define + "\n";
  source += read("lighting.glsl") + "#line 1\n" + read(file);
  GlObject shader(GlObject::Kind::kShader, stage);
  const char* text = source.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint ok = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (!ok) {
    std::string log(2048, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw EnvironmentError("the graphics driver refuses shader " + (folder_ / file).string() + ": " + log);
  }
  return shader;
}

Program& ShaderLibrary::program(const std::string& vertex, const std::string& fragment,
                                const std::vector<std::string>& defines) {
  std::string key = vertex + "|" + fragment;
  for (const std::string& define : defines) key += "|" + define;
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
  const GlObject vertex_shader = compile(vertex + ".vert", GL_VERTEX_SHADER, defines);
  const GlObject fragment_shader = compile(fragment + ".frag", GL_FRAGMENT_SHADER, defines);
  GlObject object(GlObject::Kind::kProgram);
  glAttachShader(object.id(), vertex_shader.id());
  glAttachShader(object.id(), fragment_shader.id());
  glLinkProgram(object.id());
  GLint ok = 0;
  glGetProgramiv(object.id(), GL_LINK_STATUS, &ok);
  if (!ok) throw EnvironmentError("the graphics driver cannot link shaders " + key);
  return programs_.emplace(key, Program(std::move(object))).first->second;
}

}  // namespace trocar
