// Structure sets: contours filled to the area that their polygons have, at their place, holes as holes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/contour_fill.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/rt_structures.h"

namespace trocar::test::rt_structures_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// An axial grid of 1 mm pixels and 2 mm slices from (-30, -30, 0) to (30, 30, 2 count - 2) in RAS.
ImageVolume axial_grid(int count) {
  ImageVolume grid;
  grid.size = {61, 61, count};
  grid.modality = "CT";
  grid.values.assign(grid.offset(0, 0, count), 0);
  grid.index_to_ras_mm.linear() = Eigen::Vector3d(1, 1, 2).asDiagonal();
  grid.index_to_ras_mm.translation() = Eigen::Vector3d(-30, -30, 0);
  return grid;
}

class RtStructures : public ::testing::Test {
 protected:
  LabelMap read(const std::vector<StructureFixture>& structures, const ImageVolume& grid) {
    return read_rtstruct(folder_.write("rt.dcm", dicom_file(structure_set(structures))), grid);
  }
  LabelMap read(const std::vector<StructureFixture>& structures) {
    return read_rtstruct(folder_.write("rt.dcm", dicom_file(structure_set(structures))));
  }
  static double volume_ml(const LabelMap& map, std::size_t segment = 0) {
    const Segment& one = map.segments.at(segment);
    const LabelVolume& layer = map.layers.at(one.layer);
    return static_cast<double>(layer.label_counts().at(one.number)) * layer.voxel_volume_ml();
  }
  TemporaryFolder folder_;
};

TEST(ContourFill, PixelsWhoseCentresLieInsideAreFilled) {
  const auto filled = [](const std::vector<PlaneContour>& contours) {
    int count = 0;
    fill_even_odd(contours, 20, 20, [&](int first, int last, int) { count += last - first; });
    return count;
  };
  const auto square = [](double low, double high) {
    return PlaneContour{{low, low}, {high, low}, {high, high}, {low, high}};
  };
  EXPECT_EQ(filled({square(1.5, 9.5)}), 64);
  EXPECT_EQ(filled({square(2, 10)}), 64) << "an edge through centres counts on one side only";
  EXPECT_EQ(filled({square(1.5, 9.5), square(3.5, 5.5)}), 60) << "a second contour is a hole";
  EXPECT_EQ(filled({square(1.5, 9.5), square(1.5, 9.5)}), 0);
  EXPECT_EQ(filled({square(-5, 50)}), 400) << "cut at the grid";
  EXPECT_EQ(filled({{{1.5, 1.5},
                     {9.5, 1.5},
                     {9.5, 9.5},
                     {1.5, 9.5},
                     {1.5, 5},
                     {3.5, 5},
                     {3.5, 5.5},
                     {5.5, 5.5},
                     {5.5, 3.5},
                     {3.5, 3.5},
                     {3.5, 5},
                     {1.5, 5}}}),
            60)
      << "a keyhole is a hole";
  EXPECT_EQ(filled({{{1.5, 1.5}, {1.5, 9.5}}}), 0);
  EXPECT_EQ(crossing_count({square(1.5, 9.5)}, 20), 16U);
  EXPECT_DOUBLE_EQ(contour_area(square(1.5, 9.5)), 64);
}

/// A cylinder: pi r^2 h, where every plane stands for one slice distance.
TEST_F(RtStructures, ACylinderHasItsVolumeAndPlace) {
  StructureFixture cylinder;
  for (int k = 2; k < 12; ++k) cylinder.contours.push_back(circle({5, -8, 2.0 * k}, 14, 720));
  const LabelMap map = read({cylinder}, axial_grid(20));
  const double exact = kPi * 14 * 14 * 20 / 1000;
  EXPECT_NEAR(volume_ml(map), exact, 0.01 * exact)
      << "a circle of radius 14 holds 613 lattice points, its area is 615.8";
  EXPECT_EQ(map.segments[0].name, "Liver");
  EXPECT_EQ(map.modality, "CT");
  EXPECT_TRUE(map.notes.empty()) << map.notes[0];
  const LabelVolume& layer = map.layers[0];
  EXPECT_EQ(layer.labels[layer.offset(25, 38, 5)], 1) << "centre (5, -8) in LPS is (-5, 8) in RAS";
  EXPECT_EQ(layer.labels[layer.offset(25, 38, 1)], 0);
  EXPECT_EQ(layer.labels[layer.offset(35, 22, 5)], 0);
}

TEST_F(RtStructures, HolesByASecondContourAndByAKeyhole) {
  StructureFixture ring, keyhole;
  keyhole.number = 2, keyhole.name = "Keyhole";
  for (int k = 0; k < 6; ++k) {
    const double z = 2.0 * k;
    ring.contours.push_back(rectangle(-20.5, -20.5, -0.5, -0.5, z));
    ring.contours.push_back(rectangle(-15.5, -15.5, -5.5, -5.5, z));
    keyhole.contours.push_back({{0.5, 0.5, z},
                                {20.5, 0.5, z},
                                {20.5, 20.5, z},
                                {0.5, 20.5, z},
                                {0.5, 10, z},
                                {5.5, 10, z},
                                {5.5, 15.5, z},
                                {15.5, 15.5, z},
                                {15.5, 5.5, z},
                                {5.5, 5.5, z},
                                {5.5, 10, z},
                                {0.5, 10, z}});
  }
  ring.type = "CLOSEDPLANAR_XOR";
  const LabelMap map = read({ring, keyhole}, axial_grid(6));
  EXPECT_EQ(map.layers.size(), 1U);
  EXPECT_NEAR(volume_ml(map, 0), 300 * 12 / 1000.0, 1e-9);
  EXPECT_NEAR(volume_ml(map, 1), 300 * 12 / 1000.0, 1e-9);
}

TEST_F(RtStructures, OverlappingStructuresLieInLayers) {
  StructureFixture body{1, "Body", {}, "CLOSED_PLANAR"}, liver{7, "Liver", {}, "CLOSED_PLANAR"};
  for (int k = 0; k < 5; ++k) {
    body.contours.push_back(rectangle(-20.5, -20.5, 20.5, 20.5, 2.0 * k));
    liver.contours.push_back(rectangle(-5.5, -5.5, 5.5, 5.5, 2.0 * k));
  }
  const LabelMap map = read({body, liver}, axial_grid(5));
  ASSERT_EQ(map.layers.size(), 2U);
  EXPECT_EQ(map.segments[1].name, "Liver");
  EXPECT_NEAR(volume_ml(map, 0), 41 * 41 * 10 / 1000.0, 1e-9);
  EXPECT_NEAR(volume_ml(map, 1), 11 * 11 * 10 / 1000.0, 1e-9);
}

TEST_F(RtStructures, PlanesBetweenSlicesFillTheNearestWithANote) {
  StructureFixture sparse;
  for (int k = 0; k < 5; ++k)
    sparse.contours.push_back(rectangle(-10.5, -10.5, 10.5, 10.5, 5 + 6.0 * k));  // every third slice, between two
  const LabelMap map = read({sparse}, axial_grid(20));
  EXPECT_NEAR(volume_ml(map), 21 * 21 * 30 / 1000.0, 21 * 21 * 2 / 1000.0);
  EXPECT_CONTAINS(map.notes.at(0), "slices were filled from the nearest plane");
}

TEST_F(RtStructures, AGapBetweenTwoPartsStaysAGap) {
  StructureFixture parts;
  for (const int k : {1, 2, 3, 8, 9}) parts.contours.push_back(rectangle(-10.5, -10.5, 10.5, 10.5, 2.0 * k));
  const LabelMap map = read({parts}, axial_grid(12));
  EXPECT_NEAR(volume_ml(map), 21 * 21 * 10 / 1000.0, 1e-9);
  EXPECT_EQ(map.layers[0].labels[map.layers[0].offset(30, 30, 5)], 0);
}

TEST_F(RtStructures, PlanesOutsideTheImageAreNoted) {
  StructureFixture tall;
  for (int k = 0; k < 9; ++k) tall.contours.push_back(rectangle(-5, -5, 5, 5, 2.0 * k));
  EXPECT_CONTAINS(read({tall}, axial_grid(6)).notes.at(0), "Of the 9 planes of structure 1 (Liver), 3 lie outside");
  for (auto& contour : tall.contours)
    for (Eigen::Vector3d& point : contour) point.z() += 500;
  EXPECT_CONTAINS(message_of<InputError>([&] { read({tall}, axial_grid(6)); }), "belongs to another series of images");
}

TEST_F(RtStructures, SagittalContoursFillASagittalGrid) {
  StructureFixture box;
  for (int k = 0; k < 4; ++k) {
    auto flat = rectangle(-10.5, 1, 10.5, 11, 0);
    for (Eigen::Vector3d& point : flat) point = Eigen::Vector3d(-4.0 + k, point.x(), point.y());
    box.contours.push_back(flat);
  }
  const LabelMap map = read({box}, axial_grid(8));
  EXPECT_NEAR(volume_ml(map), 4 * 21 * 10 / 1000.0, 1e-9);
}

TEST_F(RtStructures, ContoursAcrossTheSlicesAreRefused) {
  StructureFixture oblique;
  for (int k = 0; k < 4; ++k)
    oblique.contours.push_back({{-10, -10, 2.0 * k}, {10, -11, 2.0 * k + 3}, {11, 10, 2.0 * k + 8}});
  EXPECT_CONTAINS(message_of<InputError>([&] { read({oblique}, axial_grid(8)); }),
                  "structure 1 (Liver): its contours do not lie in the slices");
  oblique.contours[1][0].z() += 1;
  EXPECT_CONTAINS(message_of<InputError>([&] { read({oblique}); }), "do not lie in parallel planes");
}

TEST_F(RtStructures, WithoutAnImageTheContoursMakeTheirGrid) {
  StructureFixture ball{3, "Ball", {}, "CLOSED_PLANAR"};
  for (int k = -9; k <= 9; ++k) ball.contours.push_back(circle({100, -50, 3.0 * k}, std::sqrt(900 - 9.0 * k * k), 360));
  const LabelMap map = read({ball});
  EXPECT_CONTAINS(map.notes.at(0), "filled on a grid of their own");
  EXPECT_NEAR(map.layers[0].index_to_ras_mm.linear()(2, 2), 3, 1e-9);
  double polygons = 0;
  for (int k = -9; k <= 9; ++k) polygons += kPi * (900 - 9.0 * k * k) * 3 / 1000;
  EXPECT_NEAR(volume_ml(map), polygons, 0.005 * polygons);
}

TEST_F(RtStructures, TheStructuresAskedForDecideTheGrid) {
  StructureFixture body{7, "BODY", {}, "CLOSED_PLANAR"}, gland{9, "Gland", {}, "CLOSED_PLANAR"};
  for (int k = 0; k < 20; ++k) body.contours.push_back(rectangle(-200, -120, 200, 120, 5.0 * k));
  for (int k = 0; k < 4; ++k) gland.contours.push_back(rectangle(-6, -6, 6, 6, 31 + 2.0 * k));
  const DicomStudy study(folder_.write("rt.dcm", dicom_file(structure_set({body, gland}))));
  EXPECT_THROW(read_rtstruct(study), InputError) << "two sets of planes";
  for (const char* wanted : {"gland", "2"}) {
    const LabelMap map = read_rtstruct(study, {}, {}, {wanted});
    ASSERT_EQ(map.segments.size(), 1U);
    EXPECT_EQ(map.segments[0].name, "Gland");
    EXPECT_EQ(map.segments[0].number, 2) << "its place in the list";
    EXPECT_NEAR(map.layers[0].index_to_ras_mm.linear().col(2).norm(), 2, 1e-9);
    EXPECT_NEAR(volume_ml(map), 12 * 12 * 8 / 1000.0, 0.05);
    EXPECT_EQ(map.layers[0].labels[map.layers[0].offset(4, 4, 0)], 0) << "an empty slice at either end";
  }
}

TEST_F(RtStructures, TiltedPlanesMakeATiltedGrid) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.9, 0.25, 0.1, 0.2).normalized();
  StructureFixture slab;
  for (int k = 0; k < 6; ++k) {
    auto contour = rectangle(-12, -9, 12, 9, 2.0 * k);
    for (Eigen::Vector3d& point : contour) point = turn * point + Eigen::Vector3d(30, 40, 50);
    slab.contours.push_back(contour);
  }
  EXPECT_NEAR(volume_ml(read({slab})), 24 * 18 * 12 / 1000.0, 0.03 * 24 * 18 * 12 / 1000.0);
}

TEST_F(RtStructures, PointsAndOpenLinesAreLeftOutWithANote) {
  StructureFixture good, point{2, "Isocentre", {{{1, 2, 3}}}, "POINT"},
      line{3, "Ruler", {rectangle(0, 0, 5, 5, 2)}, "OPEN_PLANAR"};
  for (int k = 0; k < 4; ++k) good.contours.push_back(rectangle(-5, -5, 5, 5, 2.0 * k));
  const LabelMap map = read({good, point, line}, axial_grid(6));
  EXPECT_EQ(map.segments.size(), 1U);
  EXPECT_CONTAINS(map.notes.at(0), "Left out of structure 2 (Isocentre): 1 points or open lines");
  EXPECT_CONTAINS(message_of<InputError>([&] { read({point, line}, axial_grid(6)); }), "holds no closed contours");
}

TEST_F(RtStructures, OtherFilesAreRefused) {
  const auto refusal = [&](const std::string& bytes) {
    return message_of<InputError>([&] { read_rtstruct(folder_.write("x", bytes), axial_grid(3)); });
  };
  EXPECT_CONTAINS(refusal("text"), "is not a DICOM file");
  EXPECT_CONTAINS(refusal(stack_of(1, 1)[0].file()), "holds no series of structures");
  StructureFixture far;
  far.contours = {{{0, 0, 0}, {1e9, 0, 0}, {0, 5, 0}}};
  EXPECT_CONTAINS(refusal(dicom_file(structure_set({far}))), "more than 100 m away");
  const std::string whole =
      dicom_file(structure_set({StructureFixture{1, "a", {rectangle(0, 0, 1, 1, 0)}, "CLOSED_PLANAR"}}));
  EXPECT_CONTAINS(refusal(whole.substr(0, whole.size() - 30)), "damaged DICOM");
}

TEST_F(RtStructures, AFolderThatHoldsOneWillDo) {
  StructureFixture box;
  for (int k = 0; k < 4; ++k) box.contours.push_back(rectangle(-5.5, -5.5, 5.5, 5.5, 2.0 * k));
  folder_.write("set", dicom_file(structure_set({box})));
  folder_.write("image", stack_of(1, 1)[0].file());
  EXPECT_NEAR(volume_ml(read_rtstruct(folder_.path(), axial_grid(6))), 11 * 11 * 8 / 1000.0, 1e-9);
  EXPECT_EQ(read_rtstruct(folder_.path(), {}, 2).segments.size(), 1U);
  folder_.write("set2", dicom_file(structure_set({box})));
  EXPECT_CONTAINS(message_of<InputError>([&] { read_rtstruct(folder_.path()); }), "holds 2 structure sets");
}

TEST_F(RtStructures, AFileWithoutHeaderIsReadToo) {
  StructureFixture box;
  for (int k = 0; k < 4; ++k) box.contours.push_back(rectangle(-5.5, -5.5, 5.5, 5.5, 2.0 * k));
  const LabelMap map = read_rtstruct(folder_.write("bare", structure_set({box}).encoded()), axial_grid(6));
  EXPECT_NEAR(volume_ml(map), 11 * 11 * 8 / 1000.0, 1e-9);
}

}  // namespace
}  // namespace trocar::test::rt_structures_test
