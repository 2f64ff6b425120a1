#include "tissue/imaging/volumes/nifti_header.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/input_error.h"
#include "tests/tissue/support/itk_volume.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/gzip_stream.h"

namespace trocar::nifti_header_test {
namespace {

using test::NiftiFixture;

std::string refusal(const NiftiFixture& file) {
  return test::message_of<InputError>([&] { parse_nifti_header(file.header_array(), "scan.nii"); });
}

Eigen::Affine3d oblique_frame() {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = (Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix() *
                   Eigen::Vector3d(2, 1.5, 3).asDiagonal();
  frame.translation() = Eigen::Vector3d(-40, 12, 100);
  return frame;
}

TEST(NiftiHeader, ReadsSizeTypeAndFrame) {
  const NiftiHeader header = parse_nifti_header(NiftiFixture({6, 5, 4}, oblique_frame()).header_array(), "scan.nii");
  EXPECT_EQ(header.size, (std::array<int, 3>{6, 5, 4}));
  EXPECT_EQ(header.type, NiftiType::kUint8);
  EXPECT_EQ(header.frame_source, "sform 2");
  EXPECT_TRUE(header.index_to_ras_mm.isApprox(oblique_frame(), 1e-6));  // float32
  EXPECT_TRUE(header.spacing_mm().isApprox(Eigen::Vector3d(2, 1.5, 3), 1e-6));
  EXPECT_TRUE(header.notes.empty());
}

struct Spoiled {
  const char* field;
  void (*spoil)(NiftiFixture&);
};

class RefusedHeader : public ::testing::TestWithParam<Spoiled> {};

TEST_P(RefusedHeader, NamesFileAndField) {
  NiftiFixture file;
  GetParam().spoil(file);
  const std::string message = refusal(file);
  EXPECT_CONTAINS(message, "scan.nii: ");
  EXPECT_CONTAINS(message, GetParam().field);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Fields, RefusedHeader,
    ::testing::Values(
        Spoiled{"sizeof_hdr", [](NiftiFixture& f) { f.put<std::int32_t>(0, 347); }},
        Spoiled{"NIfTI-2", [](NiftiFixture& f) { f.put<std::int32_t>(0, 540); }},
        Spoiled{"magic", [](NiftiFixture& f) { f.put<char>(344, 'x'); }},
        Spoiled{"dim[0]", [](NiftiFixture& f) { f.put<std::int16_t>(40, 2); }},
        Spoiled{"dim[0]", [](NiftiFixture& f) { f.put<std::int16_t>(40, -1); }},
        Spoiled{"dim[2]", [](NiftiFixture& f) { f.put<std::int16_t>(44, 1); }},
        Spoiled{"dim[3]", [](NiftiFixture& f) { f.put<std::int16_t>(46, -7); }},
        Spoiled{"dim[4]", [](NiftiFixture& f) { f.put<std::int16_t>(40, 4), f.put<std::int16_t>(48, 3); }},
        Spoiled{"voxels",
                [](NiftiFixture& f) {
                  for (std::size_t n = 42; n < 48; n += 2) f.put<std::int16_t>(n, 30000);
                }},
        Spoiled{"datatype", [](NiftiFixture& f) { f.type(128, 24); }},
        Spoiled{"bitpix", [](NiftiFixture& f) { f.type(4, 8); }},
        Spoiled{"intent_code", [](NiftiFixture& f) { f.put<std::int16_t>(68, 1007); }},
        Spoiled{"scl_slope", [](NiftiFixture& f) { f.put(112, kNan); }},
        Spoiled{"vox_offset", [](NiftiFixture& f) { f.put(108, 100.0F); }},
        Spoiled{"vox_offset", [](NiftiFixture& f) { f.put(108, kNan); }},
        Spoiled{"pixdim[1]", [](NiftiFixture& f) { f.put(80, 0.0F); }},
        Spoiled{"pixdim[3]", [](NiftiFixture& f) { f.put(88, kNan); }},
        Spoiled{"both 0", [](NiftiFixture& f) { f.put<std::int16_t>(254, 0); }},
        Spoiled{"unknown code", [](NiftiFixture& f) { f.put<std::int16_t>(254, 99); }},
        Spoiled{"xyzt_units says metres", [](NiftiFixture& f) { f.put<std::uint8_t>(123, 1); }},
        Spoiled{"--unit mm", [](NiftiFixture& f) { f.put<std::uint8_t>(123, 3); }},
        Spoiled{"not finite", [](NiftiFixture& f) { f.put(280, kNan); }},
        Spoiled{"not finite", [](NiftiFixture& f) { f.put(292, std::numeric_limits<float>::infinity()); }},
        Spoiled{"voxel size", [](NiftiFixture& f) { f.put(280, 0.0F); }},
        Spoiled{"one plane", [](NiftiFixture& f) { f.put(284, 9.0F); }},
        Spoiled{"quatern", [](NiftiFixture& f) { f.put<std::int16_t>(252, 1), f.put(256, kNan); }},
        Spoiled{"100 m", [](NiftiFixture& f) { f.put(292, 1e9F); }}));

/// A fixture whose lengths are in a unit of so many millimetres, by sform or by qform.
NiftiFixture in_unit(std::uint8_t code, double millimetres, bool sform) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = Eigen::Vector3d(2, 1.5, 3).asDiagonal();
  frame.translation() = Eigen::Vector3d(-40, 12, 100);
  NiftiFixture file({6, 5, 4}, Eigen::Scaling(1 / millimetres) * frame);
  file.put<std::uint8_t>(123, code);
  if (sform) return file;
  file.put<std::int16_t>(254, 0), file.put<std::int16_t>(252, 1);
  for (std::size_t n = 0; n < 3; ++n)
    file.put(268 + 4 * n, static_cast<float>(frame.translation()[static_cast<int>(n)] / millimetres));
  return file;
}

TEST(NiftiHeader, LengthsInMetresOrMicrometresAreBroughtToMillimetres) {
  const Eigen::Affine3d wanted = parse_nifti_header(in_unit(2, 1, true).header_array(), "f").index_to_ras_mm;
  for (const auto& [code, millimetres, word] : {std::tuple(1, 1e3, "metres"), std::tuple(3, 1e-3, "micrometres")})
    for (const bool sform : {true, false}) {
      const NiftiHeader header =
          parse_nifti_header(in_unit(static_cast<std::uint8_t>(code), millimetres, sform).header_array(), "f");
      EXPECT_TRUE(header.index_to_ras_mm.isApprox(wanted, 1e-6)) << word << header.index_to_ras_mm.matrix();
      ASSERT_EQ(header.notes.size(), 1U);
      EXPECT_EQ(header.notes[0], "xyzt_units says " + std::string(word) + "; lengths were brought to millimetres");
    }
}

TEST(NiftiHeader, TheCallersUnitGoesBeforeADoubtfulOne) {
  const Eigen::Affine3d wanted = parse_nifti_header(in_unit(2, 1, true).header_array(), "f").index_to_ras_mm;
  for (const int code : {0, 1, 3, 7}) {
    const NiftiHeader header =
        parse_nifti_header(in_unit(static_cast<std::uint8_t>(code), 10, true).header_array(), "f", "cm");
    EXPECT_TRUE(header.index_to_ras_mm.isApprox(wanted, 1e-6)) << code;
    EXPECT_CONTAINS(header.notes.at(0), "cm was taken, as --unit says");
  }
  EXPECT_CONTAINS(parse_nifti_header(in_unit(2, 10, true).header_array(), "f", "cm").notes.at(0),
                  "the header says mm; lengths read in cm, as was asked for");
  EXPECT_CONTAINS(parse_nifti_header(in_unit(0, 1, true).header_array(), "f").notes.at(0), "millimetres assumed");
}

TEST(NiftiHeader, NegativeVoxelSizesHaveNoMeaningOfTheirOwn) {
  for (const bool sform : {true, false}) {
    NiftiFixture file = in_unit(2, 1, sform);
    const Eigen::Affine3d wanted = parse_nifti_header(file.header_array(), "f").index_to_ras_mm;
    file.put(80, -2.0F), file.put(88, -3.0F);
    const NiftiHeader header = parse_nifti_header(file.header_array(), "f");
    EXPECT_TRUE(header.index_to_ras_mm.isApprox(wanted, 1e-9));
    EXPECT_CONTAINS(header.notes.at(0), sform ? "the sform says which way" : "the qform says which way");
  }
}

TEST(NiftiHeader, ReadsTheOtherByteOrder) {
  const NiftiFixture file({6, 5, 4}, oblique_frame());
  auto raw = file.header_array();
  const auto reverse = [&](std::size_t first, std::size_t width, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n)
      std::reverse(raw.begin() + static_cast<long>(first + n * width),
                   raw.begin() + static_cast<long>(first + (n + 1) * width));
  };
  reverse(0, 4, 1);
  reverse(40, 2, 8);
  reverse(68, 2, 4);
  reverse(76, 4, 11);
  reverse(252, 2, 2);
  reverse(256, 4, 18);
  const NiftiHeader header = parse_nifti_header(raw, "scan.nii");
  EXPECT_TRUE(header.swapped);
  EXPECT_TRUE(header.index_to_ras_mm.isApprox(oblique_frame(), 1e-6));
}

TEST(NiftiHeader, QformGivesTheSameFrameAsSform) {
  for (const double qfac : {1.0, -1.0}) {
    Eigen::Affine3d frame = oblique_frame();
    const Eigen::Quaterniond q(frame.linear().colwise().normalized());
    frame.linear().col(2) *= qfac;
    NiftiFixture file({6, 5, 4}, frame);
    const double sign = q.w() < 0 ? -1 : 1;
    file.put<std::int16_t>(254, 0), file.put<std::int16_t>(252, 1), file.put(76, static_cast<float>(qfac));
    file.put(256, static_cast<float>(sign * q.x())), file.put(260, static_cast<float>(sign * q.y())),
        file.put(264, static_cast<float>(sign * q.z()));
    for (std::size_t n = 0; n < 3; ++n)
      file.put(268 + 4 * n, static_cast<float>(frame.translation()[static_cast<int>(n)]));
    const NiftiHeader header = parse_nifti_header(file.header_array(), "scan.nii");
    EXPECT_EQ(header.frame_source, "qform 1");
    EXPECT_LT((header.index_to_ras_mm.matrix() - frame.matrix()).cwiseAbs().maxCoeff(),
              1e-4);  // float32 quaternion, mm
  }
}

TEST(NiftiHeader, SaysWhenSformAndQformDisagree) {
  NiftiFixture file;
  file.put<std::int16_t>(252, 1), file.put(268, 25.0F);
  const NiftiHeader header = parse_nifti_header(file.header_array(), "scan.nii");
  ASSERT_EQ(header.notes.size(), 1U);
  EXPECT_CONTAINS(header.notes[0], "25 mm apart");
}

TEST(NiftiHeader, KeepsShearedAxesAndSaysSo) {
  NiftiFixture file;
  file.put(284, 0.3F);
  const NiftiHeader header = parse_nifti_header(file.header_array(), "scan.nii");
  ASSERT_EQ(header.notes.size(), 1U);
  EXPECT_CONTAINS(header.notes[0], "right angles");
}

// ITK places voxels in LPS: x and y of its world are ours with the sign turned.
TEST(NiftiHeader, AgreesWithItkAfterTurningLpsIntoRas) {
  test::TemporaryFolder folder;
  Eigen::Affine3d flipped = oblique_frame();
  flipped.linear().col(0) *= -1;
  for (const Eigen::Affine3d& frame : {Eigen::Affine3d::Identity(), oblique_frame(), flipped}) {
    NiftiFixture file({6, 5, 4}, frame);
    file.at(5, 0, 3) = 7;
    const auto path = folder.write("scan.nii", file.bytes());
    const NiftiHeader header = read_nifti_header(path);
    const ItkVolume volume = read_itk_volume(path);
    EXPECT_EQ(volume.values[5 + 6 * 5 * 3], 7);
    for (const Eigen::Vector3d& index :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 0, 3), Eigen::Vector3d(2, 4, 1)}) {
      Eigen::Vector3d ras;
      for (std::size_t row = 0; row < 3; ++row) {
        double place = volume.origin_mm[row];
        for (std::size_t column = 0; column < 3; ++column)
          place += volume.direction[row][column] * volume.spacing_mm[column] * index[static_cast<int>(column)];
        ras[static_cast<int>(row)] = row < 2 ? -place : place;
      }
      EXPECT_LT((ras - header.index_to_ras_mm * index).norm(), 1e-4);  // float32 in the file, mm
    }
  }
}

TEST(NiftiFile, RefusesWrongExtensionsAndSignatures) {
  test::TemporaryFolder folder;
  const std::string plain = NiftiFixture().bytes(), packed = gzip_compressed(plain);
  const auto refused = [&](const std::string& name, const std::string& bytes) {
    return test::message_of<InputError>([&] { read_nifti_header(folder.write(name, bytes)); });
  };
  EXPECT_CONTAINS(refused("scan.mha", plain), "extension");
  EXPECT_CONTAINS(refused("scan.nii.gz", plain), "not gzip");
  EXPECT_CONTAINS(refused("scan.nii", packed), "are gzip");
  EXPECT_CONTAINS(test::message_of<InputError>([] { read_nifti_header("no/scan.nii"); }), "no such file");
  EXPECT_NO_THROW(read_nifti_header(folder.write("good.nii.gz", packed)));
  EXPECT_NO_THROW(read_nifti_header(folder.write("good.nii", plain)));
}

TEST(NiftiFile, RefusesMissingData) {
  test::TemporaryFolder folder;
  const std::string plain = NiftiFixture().bytes(), packed = gzip_compressed(plain);
  const auto refused = [&](const std::string& name, const std::string& bytes) {
    return test::message_of<InputError>([&] { read_nifti_header(folder.write(name, bytes)); });
  };
  EXPECT_CONTAINS(refused("a.nii", plain.substr(0, plain.size() - 1)), "data: the file ends after 471 of 472 bytes");
  EXPECT_CONTAINS(refused("b.nii.gz", gzip_compressed(plain.substr(0, 400))), "400 of 472");
  EXPECT_CONTAINS(refused("c.nii", plain.substr(0, 300)), "300 of 348");
  EXPECT_CONTAINS(refused("d.nii.gz", packed.substr(0, packed.size() / 2)), "d.nii.gz");
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // the stored checksum
  EXPECT_CONTAINS(refused("e.nii.gz", damaged), "damaged gzip");
  EXPECT_CONTAINS(refused("f.nii", ""), "0 of 348");
}

}  // namespace
}  // namespace trocar::nifti_header_test
