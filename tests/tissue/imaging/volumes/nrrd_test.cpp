#include "tissue/imaging/volumes/nrrd_header.h"

#include "tests/tissue/imaging/volumes/volume_files.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::nrrd_test {
namespace {

using test::frame_of;
using test::packed;
using test::told_indices;

const std::string kPlace = "space directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (-10,20,30)\n";

std::string header(const std::string& more, const std::string& type = "short") {
  return "NRRD0004\n# a comment\ntype: " + type + "\ndimension: 3\nsizes: 4 3 2\n" + more;
}

std::string plain_file(const std::string& space) {
  return header("encoding: raw\nendian: little\nspace: " + space + "\n" + kPlace) + "\n" +
         packed<std::int16_t>(told_indices());
}

TEST(Nrrd, ThreeSpacesTurnIntoRas) {
  test::TemporaryFolder folder;
  const Eigen::Matrix3d steps = Eigen::Vector3d(2, 3, 4).asDiagonal();
  const Eigen::Vector3d origin(-10, 20, 30);
  const auto check = [&](const std::string& space, const Eigen::Vector3d& signs) {
    const ImageVolume image = read_image_volume(folder.write("a.nrrd", plain_file(space)));
    test::expect_told_indices(image, frame_of(signs.asDiagonal() * steps, signs.cwiseProduct(origin)));
  };
  check("right-anterior-superior", {1, 1, 1});
  check("RAS", {1, 1, 1});
  check("left-anterior-superior", {-1, 1, 1});
  check("left-posterior-superior", {-1, -1, 1});
  check("lps", {-1, -1, 1});
}

TEST(Nrrd, EncodingsAndByteOrdersGiveOneImage) {
  test::TemporaryFolder folder;
  const std::string place = "space: RAS\n" + kPlace;
  const Eigen::Affine3d frame = frame_of(Eigen::Vector3d(2, 3, 4).asDiagonal(), {-10, 20, 30});
  const auto check = [&](const std::string& bytes) {
    test::expect_told_indices(read_image_volume(folder.write("a.nrrd", bytes)), frame);
  };
  check(header(place + "encoding: raw\nendian: big\n") + "\n" + packed<std::int16_t>(told_indices(), true));
  check(header(place + "encoding: gzip\nendian: little\n", "float") + "\n" +
        gzip_compressed(packed<float>(told_indices())));
  check(header(place + "encoding: gz\nendian: big\n", "double") + "\n" +
        gzip_compressed(packed<double>(told_indices(), true)));
  check(header(place + "encoding: raw\n", "uchar") + "\n" + packed<std::uint8_t>(told_indices()));
  check(header(place + "encoding: raw\nendian: little\n", "unsigned long long int") + "\n" +
        packed<std::uint64_t>(told_indices()));
  std::string text;
  for (const double value : told_indices())
    text += std::to_string(static_cast<int>(value)) + (value > 100 ? "\n" : " ");
  check(header(place + "encoding: ascii\n") + "\n" + text);
  std::string windows = header(place + "encoding: raw\nendian: little\n") + "\n";
  for (std::size_t n = 0; (n = windows.find('\n', n)) != std::string::npos; n += 2) windows.insert(n, "\r");
  check(windows + packed<std::int16_t>(told_indices()));
}

TEST(Nrrd, ObliqueDirectionsArePlacedVoxelByVoxel) {
  test::TemporaryFolder folder;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d linear = turn * Eigen::Vector3d(0.7, 0.7, 2.5).asDiagonal();
  std::ostringstream text;
  text.precision(17);
  text << "space: LPS\nspace directions:";
  for (int n = 0; n < 3; ++n) text << " (" << linear(0, n) << "," << linear(1, n) << "," << linear(2, n) << ")";
  text << "\nspace origin: (1,2,3)\nencoding: raw\nendian: little\n";
  const ImageVolume image =
      read_image_volume(folder.write("a.nrrd", header(text.str()) + "\n" + packed<std::int16_t>(told_indices())));
  const Eigen::Vector3d signs(-1, -1, 1);
  test::expect_told_indices(image, frame_of(signs.asDiagonal() * linear, {-1, -2, 3}));
  EXPECT_TRUE(image.notes.empty());
}

TEST(Nrrd, UnitsThatDifferByAxisAreRefusedUnlessOneIsAskedFor) {
  test::TemporaryFolder folder;
  const std::string place = "encoding: raw\nendian: little\nspace: RAS\n" + kPlace;
  const std::string data = "\n" + packed<std::int16_t>(told_indices());
  const auto path = folder.write("a.nrrd", header(place + "space units: \"mm\" \"cm\" \"mm\"\n") + data);
  EXPECT_CONTAINS(test::image_refusal(path), "different units along different axes");
  const Eigen::Affine3d frame = frame_of(Eigen::Vector3d(2, 3, 4).asDiagonal(), {-10, 20, 30});
  test::expect_told_indices(read_image_volume(path, {}, {.unit = "mm", .space = ""}), frame);
  const auto alike = folder.write("b.nrrd", header(place + "space units: \"mm\" \"mm\" \"mm\"\n") + data);
  test::expect_told_indices(read_image_volume(alike), frame);
}

TEST(Nrrd, SpacingsAndAxisMinsNeedASpaceThatSomebodyNames) {
  test::TemporaryFolder folder;
  const std::string start = "encoding: raw\nendian: little\nspacings: 2 3 4\naxis mins: 10 20 30\n";
  const std::string data = "\n" + packed<std::int16_t>(told_indices());
  const auto path = folder.write("a.nrrd", header(start) + data);
  EXPECT_CONTAINS(test::image_refusal(path), "where left and right are");
  const Eigen::Matrix3d steps = Eigen::Vector3d(2, 3, 4).asDiagonal();
  const ImageVolume node = read_image_volume(path, {}, {.unit = "", .space = "RAS"});
  test::expect_told_indices(node, frame_of(steps, {10, 20, 30}));
  EXPECT_TRUE(test::has_note(node.notes, "names no space"));
  const auto cells = folder.write("b.nrrd", header(start + "centers: cell cell cell\n") + data);
  const ImageVolume cell = read_image_volume(cells, {}, {.unit = "", .space = "RAS"});
  test::expect_told_indices(cell, frame_of(steps, {11, 21.5, 32}));  // the minimum of a cell is its edge
}

TEST(Nrrd, UnitsComeFromTheHeaderOrTheCaller) {
  test::TemporaryFolder folder;
  const std::string place =
      "space: RAS\nencoding: raw\nendian: little\nspace directions: (0.002,0,0) (0,0.003,0) (0,0,0.004)\nspace origin: "
      "(0,0,0)\n";
  const std::string data = "\n" + packed<std::int16_t>(told_indices());
  const auto unnamed = folder.write("a.nrrd", header(place) + data);
  EXPECT_CONTAINS(test::image_refusal(unnamed), "--unit");
  const Eigen::Affine3d frame = frame_of(Eigen::Vector3d(2, 3, 4).asDiagonal(), {0, 0, 0});
  test::expect_told_indices(read_image_volume(unnamed, {}, {.unit = "m", .space = ""}), frame);
  const auto named = folder.write("b.nrrd", header(place + "space units: \"m\" \"m\" \"m\"\n") + data);
  test::expect_told_indices(read_image_volume(named), frame);
  EXPECT_CONTAINS(test::image_refusal(unnamed, {.unit = "furlong", .space = ""}), "no unit of length");
}

TEST(Nrrd, DetachedVoxelsBesideTheHeaderAndNowhereElse) {
  test::TemporaryFolder folder;
  const std::string rest = "encoding: raw\nendian: little\nspace: RAS\n" + kPlace;
  const std::string voxels = packed<std::int16_t>(told_indices());
  std::filesystem::create_directories(folder / "below");
  folder.write("voxels.raw", "two\nlines\n" + voxels);
  folder.write("below/voxels.raw", voxels);
  const Eigen::Affine3d frame = frame_of(Eigen::Vector3d(2, 3, 4).asDiagonal(), {-10, 20, 30});
  const auto read = [&](const std::string& more) {
    return read_image_volume(folder.write("a.nhdr", header(rest + more)));
  };
  test::expect_told_indices(read("data file: voxels.raw\nline skip: 2\n"), frame);
  test::expect_told_indices(read("datafile: voxels.raw\nbyte skip: 10\n"), frame);
  test::expect_told_indices(read("data file: voxels.raw\nbyte skip: -1\n"), frame);
  test::expect_told_indices(read("data file: below/voxels.raw\n"), frame);
  const auto refused = [&](const std::string& more) { return test::message_of<InputError>([&] { read(more); }); };
  EXPECT_CONTAINS(refused("data file: /etc/hostname\n"), "out of the header's own folder");
  EXPECT_CONTAINS(refused("data file: ../voxels.raw\n"), "out of the header's own folder");
  EXPECT_CONTAINS(refused("data file: below/../../voxels.raw\n"), "out of the header's own folder");
  EXPECT_CONTAINS(refused("data file: gone.raw\n"), "not beside the header");
  EXPECT_CONTAINS(refused("data file: a.nhdr\n"), "names the header itself");
  EXPECT_CONTAINS(refused("data file: LIST\nvoxels.raw\n"), "a.nhdr");
  EXPECT_CONTAINS(refused("data file: slice%03d.raw 1 9 1\n"), "several files");
  EXPECT_CONTAINS(refused("data file: voxels.raw\nline skip: 900\n"), "fewer lines");
  EXPECT_CONTAINS(refused(""), "no field names a data file");
}

struct Wrong {
  const char* from;
  const char* to;
  const char* message;
};

class WrongNrrd : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongNrrd, IsRefusedByName) {
  test::TemporaryFolder folder;
  std::string bytes = plain_file("RAS");
  const auto place = bytes.find(GetParam().from);
  ASSERT_NE(place, std::string::npos);
  bytes.replace(place, std::strlen(GetParam().from), GetParam().to);
  const std::string message = test::image_refusal(folder.write("a.nrrd", bytes));
  EXPECT_CONTAINS(message, "a.nrrd");
  EXPECT_CONTAINS(message, GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Headers, WrongNrrd,
    ::testing::Values(
        Wrong{"encoding: raw", "encoding: bzip2", "bzip2 is not read here"},
        Wrong{"encoding: raw", "encoding: hex", "hex is not read"}, Wrong{"encoding: raw", "encoding: zip", "unknown"},
        Wrong{"encoding: raw\n", "", "encoding: missing"}, Wrong{"endian: little\n", "", "endian"},
        Wrong{"endian: little", "endian: middle", "neither little nor big"},
        Wrong{"type: short", "type: block", "type"}, Wrong{"space: RAS", "space: 3D-right-handed", "left and right"},
        Wrong{"space: RAS", "space: left-posterior-superior-time", "series"},
        Wrong{"sizes: 4 3 2", "sizes: 4 3", "2 entries for 3 axes"}, Wrong{"sizes: 4 3 2", "sizes: 4 -3 2", "sizes"},
        Wrong{"sizes: 4 3 2", "sizes: 4 3 1", "at least 2"}, Wrong{"sizes: 4 3 2", "sizes: 1e5 1e5 1e5", "more than"},
        Wrong{"sizes: 4 3 2", "sizes: 400 300 200", "the file ends after"},
        Wrong{"sizes: 4 3 2", "sizes: 4 3 two", "no number"}, Wrong{"dimension: 3", "dimension: 2", "a volume has 3"},
        Wrong{"dimension: 3", "dimension: 99", "no whole number"},
        Wrong{"type: short", "type: short\ntype: short", "given twice"}, Wrong{"(0,0,4)", "(0,0,0)", "voxel size 0"},
        Wrong{"(0,0,4)", "(0,0,nan)", "not finite"}, Wrong{"(0,0,4)", "(0,0)", "another length"},
        Wrong{"(0,0,4)", "none", "lie in space"}, Wrong{"(0,0,4)", "(2,0,0.1)", "one plane"},
        Wrong{"(0,0,4)", "(0,0,4", "neither"}, Wrong{"(-10,20,30)", "(-1e9,20,30)", "100 m"},
        Wrong{"NRRD0004", "NRRD0009", "NRRD0006"}, Wrong{"# a comment", "a comment", "neither a field nor a key"},
        Wrong{"space: RAS", "space: RAS\nkinds: domain domain time", "series over time"}));

TEST(Nrrd, TruncatedAndSpoiledDataIsRefused) {
  test::TemporaryFolder folder;
  const std::string whole = plain_file("RAS");
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.nrrd", whole.substr(0, whole.size() - 1))),
                  "the file ends after");
  const std::string start = header("space: RAS\nencoding: gzip\nendian: little\n" + kPlace) + "\n";
  const std::string data = gzip_compressed(packed<std::int16_t>(told_indices()));
  std::string damaged = start + data;
  damaged[damaged.size() - 6] ^= 1;
  EXPECT_CONTAINS(test::image_refusal(folder.write("b.nrrd", damaged)), "damaged gzip");
  EXPECT_CONTAINS(test::image_refusal(folder.write("c.nrrd", start + data.substr(0, data.size() / 2))), "damaged gzip");
  const auto text = [&](const std::string& numbers) {
    return test::image_refusal(
        folder.write("d.nrrd", header("space: RAS\nencoding: ascii\n" + kPlace) + "\n" + numbers));
  };
  EXPECT_CONTAINS(text("1 2 3"), "too short");
  EXPECT_CONTAINS(text("1 2 3" + std::string(60, ' ')), "the text ends after 3 of 24 values");
  EXPECT_CONTAINS(text("1 2 x" + std::string(60, ' ')), "value 2 of the text is no number");
  const ImageVolume more = read_image_volume(folder.write("e.nrrd", whole + "and more"));
  EXPECT_TRUE(test::has_note(more.notes, "more bytes"));
}

// A few bytes of gzip cannot be made to fill gigabytes: the claim is refused before any room is made for it.
TEST(Nrrd, HeaderThatClaimsMoreThanItsBytesCanHoldIsRefused) {
  test::TemporaryFolder folder;
  std::string start = header("space: RAS\nencoding: gzip\nendian: little\n" + kPlace) + "\n";
  start.replace(start.find("sizes: 4 3 2"), 12, "sizes: 512 512 900");
  const std::string bomb = start + gzip_compressed(std::string(1 << 20, '\0'));
  EXPECT_CONTAINS(test::image_refusal(folder.write("a.nrrd", bomb)), "too short");
}

}  // namespace
}  // namespace trocar::nrrd_test
