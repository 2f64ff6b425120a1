// Segmentations as 3D Slicer saves them: names, layers, and the old form with one component a segment.
#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tests/tissue/support/label_files.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::seg_nrrd_test {
namespace {

const std::string kFrame3 = "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\n";
const std::string kFrame4 = "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\n";

std::string start(const std::string& sizes, const std::string& frame, const std::string& keys) {
  return "NRRD0004\ntype: unsigned char\ndimension: " + std::string(sizes.size() > 6 ? "4" : "3") +
         "\nspace: right-anterior-superior\nsizes: " + sizes + "\n" + frame +
         "encoding: gzip\nspace origin: (0,0,0)\n" + keys + "\n";
}

/// Two layers of 2 x 2 x 2 voxels; the first value of each pair is layer 0.
std::string layered(const std::string& keys, std::vector<double> pairs) {
  pairs.resize(16, 0);
  return start("2 2 2 2", kFrame4, keys) + gzip_compressed(test::packed<std::uint8_t>(pairs));
}

const std::string kOverlap =
    "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment0_Extent:=0 1 0 1 0 1\n"
    "Segment1_Name:=left lobe\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n"
    "Segment2_Name:=spleen\nSegment2_LabelValue:=2\nSegment2_Layer:=0\n";

TEST(SegNrrd, OverlappingSegmentsLieInLayers) {
  test::TemporaryFolder folder;
  const auto path = folder.write("a.seg.nrrd", layered(kOverlap, {1, 1, 1, 0, 2, 1}));
  const LabelMap map = read_label_map(path);
  ASSERT_EQ(map.layers.size(), 2U);
  EXPECT_EQ(map.layers[0].labels, (std::vector<std::uint16_t>{1, 1, 2, 0, 0, 0, 0, 0}));
  EXPECT_EQ(map.layers[1].labels, (std::vector<std::uint16_t>{1, 0, 1, 0, 0, 0, 0, 0}));
  ASSERT_EQ(map.segments.size(), 3U);
  EXPECT_EQ(map.segments[0].name, "liver");
  EXPECT_EQ(map.segments[1].name, "spleen");
  EXPECT_EQ(map.segments[2].name, "left lobe");
  EXPECT_EQ(map.segments[2].layer, 1U);
  EXPECT_EQ(choose_segment(map, "left lobe", nullptr, "a").layer, 1U);
  const std::string both = test::message_of<InputError>([&] { choose_segment(map, "1", nullptr, "a.seg.nrrd"); });
  EXPECT_CONTAINS(both, "\"1\" means 2 segments: 1 liver (layer 0), 1 left lobe (layer 1)");
  EXPECT_CONTAINS(both, "--label \"liver\" or --label \"left lobe\"");
  EXPECT_EQ(choose_segment(map, "1:1", nullptr, "a").name, "left lobe");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { choose_segment(map, "1:7", nullptr, "a"); }),
                  "layer 1 holds no label 7");
  EXPECT_CONTAINS(test::message_of<InputError>([&] { test::read_label_volume(path); }), "2 layers");
  EXPECT_CONTAINS(test::image_refusal(path), "a segmentation, not an image");
}

/// 2 x 2 x 2 voxels of these values, with these keys in the header.
LabelMap one_layer(const std::string& keys, const std::vector<double>& values) {
  const test::TemporaryFolder folder;
  return read_label_map(
      folder.write("a.seg.nrrd", start("2 2 2", kFrame3, keys) + gzip_compressed(test::packed<std::uint8_t>(values))));
}

TEST(SegNrrd, OneLayerKeepsItsNames) {
  const std::string keys =
      "Segment0_Name:=gall\tbladder\nSegment0_LabelValue:=7\nSegment0_Layer:=0\nSegment1_Name:=never\nSegment1_"
      "LabelValue:=8\n";
  const LabelMap map = one_layer(keys, {7, 0, 0, 7, 3, 0, 0, 0});
  ASSERT_EQ(map.segments.size(), 2U);
  EXPECT_EQ(map.segments[0].number, 3);
  EXPECT_EQ(map.segments[0].name, "");  // the file does not name it
  EXPECT_EQ(map.segments[1].name, "gall bladder");
  EXPECT_TRUE(test::has_note(map.notes, "\"never\" marks no voxel"));
}

/// "Leber" with an a umlaut of Latin-1: guessed at it would be another name.
TEST(SegNrrd, ANameThatIsNotUtf8IsNone) {
  const std::string keys =
      "Segment0_Name:=Le\xe4"
      "ber\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n";
  const LabelMap map = one_layer(keys, {1, 0, 0, 1, 0, 0, 0, 0});
  ASSERT_EQ(map.segments.size(), 1U);
  EXPECT_EQ(map.segments[0].name, "");
  EXPECT_TRUE(test::has_note(map.notes, "Segment0_Name: the name is not UTF-8"));
}

/// Shown is what a terminal bears, and what was changed for it is told; 80 bytes end between two letters.
TEST(SegNrrd, ANameThatIsCutOrHoldsControlCharactersIsTold) {
  const auto read = [](const std::string& name) {
    const test::TemporaryFolder folder;
    const std::string keys = "Segment0_Name:=" + name + "\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n";
    return read_label_map(folder.write(
        "a.seg.nrrd",
        start("2 2 2", kFrame3, keys) + gzip_compressed(test::packed<std::uint8_t>({1, 0, 0, 1, 0, 0, 0, 0}))));
  };
  const std::string letters = std::string(79, 'x');
  EXPECT_FALSE(test::has_note(read(letters + "y").notes, "Segment0_Name"));
  const LabelMap cut = read(letters + "\u00e4 and more");
  EXPECT_EQ(cut.segments.at(0).name, letters);
  EXPECT_TRUE(test::has_note(cut.notes, "Segment0_Name: the name is longer than 80 bytes, and was cut to \"xxx"));
  const LabelMap control = read("li\x1b[31mver\u009b");
  EXPECT_EQ(control.segments.at(0).name, "li [31mver");
  EXPECT_TRUE(test::has_note(control.notes, "Segment0_Name: blanks stand for control characters: \"li [31mver\""));
}

TEST(SegNrrd, OldFormHasOneComponentASegment) {
  test::TemporaryFolder folder;
  const std::string keys = "Segment0_ID:=S1\nSegment0_Name:=liver\nSegment1_ID:=S2\nSegment1_Name:=tumour\n";
  const LabelMap map = read_label_map(folder.write("a.seg.nrrd", layered(keys, {1, 1, 1, 0})));
  ASSERT_EQ(map.segments.size(), 2U);
  EXPECT_EQ(map.segments[0].name, "liver");
  EXPECT_EQ(map.segments[1].name, "tumour");
  EXPECT_EQ(map.segments[1].layer, 1U);
  EXPECT_EQ(map.segments[1].number, 1);
}

TEST(SegNrrd, EmptyLayersAreLeftOut) {
  test::TemporaryFolder folder;
  const std::string keys =
      "Segment0_Name:=gone\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_Name:=here\nSegment1_LabelValue:="
      "1\nSegment1_Layer:=1\n";
  const LabelMap map = read_label_map(folder.write("a.seg.nrrd", layered(keys, {0, 1})));
  ASSERT_EQ(map.layers.size(), 1U);
  ASSERT_EQ(map.segments.size(), 1U);
  EXPECT_EQ(map.segments[0].name, "here");
  EXPECT_EQ(map.segments[0].layer, 0U);
}

TEST(SegNrrd, LayersLastAmongTheAxesAreReadToo) {
  test::TemporaryFolder folder;
  const std::string frame = "space directions: (1,0,0) (0,1,0) (0,0,1) none\nkinds: domain domain domain list\n";
  std::vector<double> values(16, 0);
  values[0] = 2, values[8 + 1] = 1;
  const LabelMap map = read_label_map(folder.write(
      "a.seg.nrrd", start("2 2 2 2", frame, kOverlap) + gzip_compressed(test::packed<std::uint8_t>(values))));
  ASSERT_EQ(map.layers.size(), 2U);
  EXPECT_EQ(map.layers[0].labels[0], 2);
  EXPECT_EQ(map.layers[1].labels[1], 1);
}

TEST(SegNrrd, ImpossibleSegmentsAreRefusedWithTheirLine) {
  test::TemporaryFolder folder;
  const auto refused = [&](const std::string& keys) {
    return test::map_refusal(folder.write("a.seg.nrrd", layered(keys, {1, 1})));
  };
  EXPECT_CONTAINS(refused("Segment0_LabelValue:=one\n"), "a.seg.nrrd:10:1: Segment0_LabelValue");
  EXPECT_CONTAINS(refused("Segment0_LabelValue:=-4\n"), "no whole number");
  EXPECT_CONTAINS(refused("Segment0_LabelValue:=1\nSegment0_Layer:=5\n"), "layer 5 of 2");
  EXPECT_CONTAINS(refused("Segment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_LabelValue:=1\nSegment1_Layer:=0\n"),
                  "another segment has number 1");
  EXPECT_CONTAINS(refused(""), "no segments named");
}

TEST(SegNrrd, ColoursAndSeriesAreNoVolume) {
  test::TemporaryFolder folder;
  const auto path = folder.write("a.nrrd", layered("", {1, 2}));
  EXPECT_CONTAINS(test::image_refusal(path), "2 values a voxel");
  const std::string four = "space directions: (1,0,0) (0,1,0) (0,0,1) (0,0,1)\n";
  EXPECT_CONTAINS(test::image_refusal(folder.write("b.nrrd", start("2 2 2 2", four, "") + "x")),
                  "4 axes that lie in space");
}

}  // namespace
}  // namespace trocar::seg_nrrd_test
