#include "tissue/organ/mesh_alone.h"

#include <gtest/gtest.h>

#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::mesh_alone_test {
namespace {

/// Two halves of a ball (1 below, 2 above) and a label beside them that is not asked for.
LabelMap halves() {
  LabelVolume volume = test::ball_volume(28, 2, {0, 0, 0}, 20);
  for (int k = 0; k < 28; ++k)
    for (int j = 0; j < 28; ++j)
      for (int i = 0; i < 28; ++i) {
        auto& label = volume.labels[volume.offset(i, j, k)];
        if (label != 0) label = i >= 20 ? 3 : k < 14 ? 1 : 2;
      }
  LabelMap map;
  map.layers.push_back(volume);
  return map;
}

const std::vector<SceneRequest> kRequests{{0, 1, "low", 700}, {0, 2, "high", 700}};

TEST(MeshAlone, ACleanSceneStaysAsItIs) {
  CompiledScene scene = compile_scene(halves(), kRequests, {});
  const auto before = scene.organs[0].surface.vertices;
  const std::size_t notes = scene.notes.size(), attachments = scene.attachments.size();
  mesh_alone_what_cuts_itself(halves(), kRequests, {}, scene);
  EXPECT_EQ(scene.organs[0].surface.vertices, before);
  EXPECT_EQ(scene.notes.size(), notes);
  EXPECT_EQ(scene.attachments.size(), attachments);
}

TEST(MeshAlone, WhatCutsItselfBecomesTheMeshOfItsLabelAndSharesNoTriangles) {
  CompiledScene scene = compile_scene(halves(), kRequests, {});
  ASSERT_EQ(scene.shared.size(), 1U);
  const double area = scene.shared[0].area_m2;
  ASSERT_FALSE(scene.attachments.empty());
  const auto neighbour = scene.organs[1].surface.vertices;
  scene.organs[0].facts.self_intersections = 4;
  mesh_alone_what_cuts_itself(halves(), kRequests, {}, scene);
  const CompiledOrgan alone = compile_label(halves().layers[0], 1, {700, {}, {}});
  EXPECT_EQ(scene.organs[0].surface.vertices, alone.surface.vertices);
  EXPECT_EQ(scene.organs[0].facts.self_intersections, 0U);
  EXPECT_EQ(scene.organs[1].surface.vertices, neighbour);
  EXPECT_TRUE(scene.shared[0].triangles.empty());
  EXPECT_EQ(scene.shared[0].area_m2, area);
  for (const Attachment& attachment : scene.attachments) EXPECT_NE(attachment.organ, 0U);
  EXPECT_CONTAINS(scene.notes.back(), "low cut itself in 4 places of the common mesh and was meshed alone");
}

}  // namespace
}  // namespace trocar::mesh_alone_test
