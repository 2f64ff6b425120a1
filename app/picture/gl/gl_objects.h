// Owners of OpenGL objects, programs made from shader files, and meshes on the GPU.
//
// Handles are plain unsigned numbers, so no GL header is needed here. Thread: the one on which the context is current;
// objects die before their context.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/picture/models/picture_mesh.h"

namespace trocar {

/// Move-only owner of one GL object.
class GlObject {
 public:
  enum class Kind { kNone, kBuffer, kVertexArray, kTexture, kFramebuffer, kProgram, kShader };

  GlObject() = default;
  explicit GlObject(Kind kind, unsigned shader_stage = 0);
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : kind_(other.kind_), id_(std::exchange(other.id_, 0U)) {}
  GlObject& operator=(GlObject&& other) noexcept;
  unsigned id() const { return id_; }

 private:
  void reset();
  Kind kind_ = Kind::kNone;
  unsigned id_ = 0;
};

/// A triangle mesh of PictureVertex on the GPU. Attributes: 0 place, 1 normal, 2 light; after move() also 3 place
/// and 4 normal at rest; 5 fields, where there are some.
class GpuMesh {
 public:
  GpuMesh() = default;
  explicit GpuMesh(const PictureMesh& mesh);
  /// Shows other vertices from now on, as many as the mesh's own, which stay as those at rest.
  void move(const std::vector<PictureVertex>& vertices);
  /// Four numbers at every vertex, 0 to 255 for 0 to 1.
  void set_fields(const std::vector<std::array<std::uint8_t, 4>>& fields);
  void draw() const;
  /// Draws a list of vertex indices of this mesh (three a triangle) held in `indices`.
  void draw_subset(const GlObject& indices, int count) const;

 private:
  GlObject array_, vertices_, indices_, moved_, fields_;
  int count_ = 0;
};

/// Index list on the GPU, for GpuMesh::draw_subset.
GlObject upload_indices(const std::vector<std::uint32_t>& indices);

/// A linked program with cached uniform locations.
class Program {
 public:
  explicit Program(GlObject object) : object_(std::move(object)) {}
  void use() const;
  /// Location of a uniform; -1 when the variant does not use it (setting it is then a no-op in GL).
  int uniform(const std::string& name);
  /// Ties a uniform block to a binding point; no-op when the variant does not use the block.
  void bind_block(const std::string& name, unsigned binding) const;

 private:
  GlObject object_;
  std::map<std::string, int> locations_;
};

/// Compiles variants of the shaders in asset_root/shaders: one program per set of #defines, never a uniform branch,
/// because software rasterisers run both sides of a branch.
class ShaderLibrary {
 public:
  explicit ShaderLibrary(std::filesystem::path asset_root) : folder_(std::move(asset_root) / "shaders") {}
  /// Program from NAME.vert and NAME.frag with the given defines; compiled at the first call.
  /// @throws EnvironmentError naming the file when it is missing or the driver refuses it.
  Program& program(const std::string& vertex, const std::string& fragment,
                   const std::vector<std::string>& defines = {});

 private:
  GlObject compile(const std::string& file, unsigned stage, const std::vector<std::string>& defines) const;
  std::string read(const std::string& file) const;
  std::filesystem::path folder_;
  std::map<std::string, Program> programs_;
};

}  // namespace trocar
