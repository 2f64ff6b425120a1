// A surface follows its lattice: at rest it stands where it stood, and what is affine in the nodes is affine in it.
#include "tissue/solid/embedded_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "haptics/input_error.h"

namespace trocar::embedded_surface_test {
namespace {

TriangleSurface octahedron() {
  TriangleSurface s;
  for (const int sign : {1, -1})
    for (int axis = 0; axis < 3; ++axis) s.vertices.push_back(0.03 * sign * Vec3::Unit(axis) + Vec3(0.1, 0.05, -0.2));
  s.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  return s;
}

class EmbeddedOctahedron : public ::testing::Test {
 protected:
  std::vector<NodePlace> nodes(const Mat3& A = Mat3::Identity(), const Vec3& b = Vec3::Zero()) const {
    std::vector<NodePlace> out;
    for (std::size_t n = 0; n < lattice_.nodes.size(); ++n) out.push_back((A * lattice_.node_m(n) + b).cast<float>());
    return out;
  }
  TriangleSurface rest_ = octahedron();
  Lattice lattice_ = build_lattice(rest_, {.cell_m = 0.01}).lattice;
  EmbeddedSurface embedded_{lattice_, still_surface(rest_)};
};

TEST_F(EmbeddedOctahedron, FollowsAnyAffineMotionOfItsNodes) {
  Mat3 A;
  A << 1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.05, 1;
  for (const auto& [M, b] : {std::pair<Mat3, Vec3>(Mat3::Identity(), Vec3::Zero()), {A, Vec3(0.01, -0.02, 0.03)}}) {
    const SurfacePtr moved = embedded_.at(nodes(M, b));
    ASSERT_EQ(moved->vertices.size(), rest_.vertices.size());
    for (std::size_t v = 0; v < rest_.vertices.size(); ++v)
      EXPECT_LT((moved->vertices[v] - (M * rest_.vertices[v] + b)).norm(), 1e-7) << "weights and nodes are floats";
    EXPECT_EQ(moved->triangles, rest_.triangles);
    EXPECT_EQ(moved->rest, embedded_.rest());
  }
}

TEST_F(EmbeddedOctahedron, SpreadsFieldsOfNodesAndTakesThoseOfVertices) {
  ShapeField linear{"wet", FieldPlace::kNodes, {}};
  for (std::size_t n = 0; n < lattice_.nodes.size(); ++n)
    linear.value.push_back(static_cast<float>(lattice_.node_m(n).x()));
  const ShapeField own{"char", FieldPlace::kVertices, {0, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f}};
  const std::vector<ShapeField> fields{linear, own};
  const SurfacePtr at = embedded_.at(nodes(), fields);
  ASSERT_EQ(at->fields.size(), 2u);
  EXPECT_EQ(at->fields[0].name, "wet");
  for (std::size_t v = 0; v < rest_.vertices.size(); ++v)
    EXPECT_NEAR(at->fields[0].value[v], rest_.vertices[v].x(), 1e-6);
  EXPECT_EQ(at->fields[1].value, own.value);
}

TEST_F(EmbeddedOctahedron, RefusesWhatIsNotItsOwn) {
  std::vector<NodePlace> few = nodes();
  few.pop_back();
  EXPECT_THROW(embedded_.at(few), InputError);
  const std::vector<ShapeField> fields{{"char", FieldPlace::kVertices, {1}}};
  EXPECT_THROW(embedded_.at(nodes(), fields), InputError);
  TriangleSurface other = rest_;
  other.vertices.pop_back();
  EXPECT_THROW(EmbeddedSurface(lattice_, still_surface(other)), InputError);
}

}  // namespace
}  // namespace trocar::embedded_surface_test
