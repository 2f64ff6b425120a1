// The readers on real DICOM files of many makers; skipped, loudly, where the shared data folder is missing.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "haptics/input_error.h"
#include "tests/tissue/support/label_files.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/dicom/contour_fill.h"
#include "tissue/imaging/dicom/dicom_pixels.h"
#include "tissue/imaging/dicom/dicom_reader.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/rt_structures.h"
#include "tissue/imaging/dicom/structure_contours.h"
#include "tissue/imaging/labels/label_grid.h"

namespace trocar::test::dicom_shared_data_test {
namespace {

namespace fs = std::filesystem;

class DicomSharedData : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* elsewhere = std::getenv("TROCAR_SHARED");
    data_ = fs::path(elsewhere != nullptr ? elsewhere : TROCAR_SOURCE_DIR "/../shared") / "data" / "dicom";
    if (fs::is_directory(data_)) return;
    std::cerr << "SKIPPED: no shared data in " << data_ << "; real DICOM files were NOT tested\n";
    GTEST_SKIP() << "no shared data in " << data_;
  }

  std::string refusal(const fs::path& name) const {
    return message_of<InputError>([&] { read_dicom_series(data_ / name); });
  }

  /// Stored values of the first frame of one file.
  std::vector<float> stored(const fs::path& name) const {
    InflateBudget budget;
    std::unique_ptr<ByteSource> source;
    const auto elements = read_dicom_elements(data_ / name, name.string(), budget, &source);
    const DicomInstance instance = instance_of(*elements, data_ / name, name.string(), source->size());
    EXPECT_EQ(instance.problem, "");
    std::vector<float> result;
    DicomPixels::read({{&instance, 0}}, {}, [&](std::size_t, const std::vector<float>& values) { result = values; });
    return result;
  }

  static std::pair<float, float> range(const std::vector<float>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, *high};
  }

  fs::path data_;
};

/// The image data of a gzip NRRD of shorts, as it lies in the file.
std::vector<std::int16_t> nrrd_shorts(const fs::path& path, std::size_t count) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  const std::size_t start = bytes.find("\n\n") + 2;
  std::vector<std::int16_t> values(count);
  z_stream stream{};
  inflateInit2(&stream, 16 + MAX_WBITS);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + start));
  stream.avail_in = static_cast<uInt>(bytes.size() - start);
  stream.next_out = reinterpret_cast<Bytef*>(values.data());
  stream.avail_out = static_cast<uInt>(2 * count);
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  return values;
}

/// dcmqi's liver: the same label map as SEG and as NRRD (LPS, so both in-plane axes run the other way).
TEST_F(DicomSharedData, SegmentationEqualsItsNrrdVoxelByVoxel) {
  const LabelMap map = read_dicom_segmentation(data_ / "ct_3slice_liver_dcmqi/liver.dcm");
  ASSERT_EQ(map.layers.size(), 1U);
  ASSERT_EQ(map.segments.size(), 1U);
  EXPECT_EQ(map.segments[0].name, "Liver");
  const LabelVolume& layer = map.layers[0];
  ASSERT_EQ(layer.size, (std::array<int, 3>{512, 512, 5})) << "an empty slice before and behind";
  const auto truth = nrrd_shorts(data_ / "ct_3slice_liver_dcmqi/liver_seg.nrrd", layer.offset(0, 0, 3));
  std::size_t different = 0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 512; ++j)
      for (int i = 0; i < 512; ++i)
        different += layer.labels[layer.offset(511 - i, 511 - j, k + 1)] != truth[layer.offset(i, j, k)] ? 1 : 0;
  EXPECT_EQ(different, 0U);
  EXPECT_EQ(layer.label_counts().at(1), 107098U);
  const Eigen::Vector3d corner = layer.index_to_ras_mm * Eigen::Vector3d(511, 511, 1);
  EXPECT_LT((corner - Eigen::Vector3d(235.2, 226.8, -128.69)).norm(), 1e-3);
}

TEST_F(DicomSharedData, SegmentationLiesOnItsImages) {
  const ImageVolume image = read_dicom_series(data_ / "ct_3slice_liver_dcmqi");
  const LabelMap map = read_dicom_segmentation(data_ / "ct_3slice_liver_dcmqi");
  ASSERT_TRUE(common_grid(grid_of(image), grid_of(map.layers[0])));
  const LabelVolume layer = resampled_to(map.layers[0], grid_of(image));
  EXPECT_EQ(layer.label_counts(), map.layers[0].label_counts());
  double sum = 0;
  for (std::size_t n = 0; n < image.values.size(); ++n)
    sum += layer.labels[n] != 0 ? static_cast<double>(image.values[n]) : 0;
  EXPECT_NEAR(sum / 107098, 45, 20) << "liver without contrast medium, Hounsfield units";
}

/// dicom2nifti's own expectation of this series.
TEST_F(DicomSharedData, GenericMrEqualsItsNifti) {
  const ImageVolume image = read_dicom_series(data_ / "mr_generic");
  const LabelVolume truth = test::read_label_volume(data_ / "mr_generic/001_ground_truth.nii.gz");
  ASSERT_EQ(image.size, truth.size);
  EXPECT_LT((image.index_to_ras_mm.matrix() - truth.index_to_ras_mm.matrix()).norm(), 1e-3);
  std::size_t different = 0;
  for (std::size_t n = 0; n < image.values.size(); ++n)
    different += image.values[n] != static_cast<float>(truth.labels[n]) ? 1 : 0;
  EXPECT_EQ(different, 0U);
  EXPECT_EQ(image.modality, "MR");
}

TEST_F(DicomSharedData, Jpeg2000AndRleGiveTheSameSeries) {
  const ImageVolume j2k = read_dicom_series(data_ / "mr_generic_j2k"),
                    rle = read_dicom_series(data_ / "mr_generic_rle");
  EXPECT_EQ(j2k.values, rle.values);
  EXPECT_EQ(j2k.index_to_ras_mm.matrix(), rle.index_to_ras_mm.matrix());
  EXPECT_EQ(range(j2k.values), (std::pair<float, float>{0, 254}));
}

TEST_F(DicomSharedData, OneSliceInEightEncodings) {
  const std::vector<float> plain = stored("single_small/MR_small.dcm");
  EXPECT_EQ(plain.size(), 64U * 64U);
  EXPECT_EQ(range(plain), (std::pair<float, float>{127, 2145}));
  for (const char* other : {"RLE", "bigendian", "implicit", "jp2klossless", "jpeg_ls_lossless", "padded"})
    EXPECT_EQ(stored("single_small/MR_small_" + std::string(other) + ".dcm"), plain) << other;
  EXPECT_EQ(range(stored("single_small/CT_small.dcm")), (std::pair<float, float>{128, 2191}));
  EXPECT_EQ(range(stored("single_small/CT1_J2KR")), (std::pair<float, float>{-2000, 2278}));
}

TEST_F(DicomSharedData, LegoPhantomIsSortedByPosition) {
  const ImageVolume image = read_dicom_series(data_ / "ct_lego_phantom");
  EXPECT_EQ(image.size, (std::array<int, 3>{512, 512, 44}));
  EXPECT_NEAR(image.index_to_ras_mm.linear()(2, 2), 1.875, 1e-6) << "SliceThickness says 0.625";
  EXPECT_NEAR(image.index_to_ras_mm.translation().z(), -167.625, 1e-6);
  const auto slice_range = [&](int k) {
    const auto begin = image.values.begin() + static_cast<std::ptrdiff_t>(image.offset(0, 0, k));
    return range(std::vector<float>(begin, begin + 512 * 512)).second + 1024;
  };
  EXPECT_EQ(slice_range(0), 1365) << "249.dcm, the first by position";
  EXPECT_EQ(slice_range(1), 1353) << "239.dcm";
  EXPECT_EQ(slice_range(5), 1473) << "212.dcm";
  EXPECT_TRUE(image.notes.empty());
}

/// A tilted gantry: the sheared volume holds at each pixel's place in the patient what the pixel held.
TEST_F(DicomSharedData, TiltedHeadIsShearedBack) {
  const ImageVolume image = read_dicom_series(data_ / "ct_tilted_head_phantom");
  ASSERT_EQ(image.notes.size(), 1U);
  EXPECT_CONTAINS(image.notes[0], "tilted by 18.50 degrees");
  EXPECT_CONTAINS(image.notes[0], "0.793 mm a slice");
  EXPECT_NEAR(image.index_to_ras_mm.linear().col(2).norm(), 2.371, 1e-3);
  const Eigen::Matrix3d axes = image.index_to_ras_mm.linear().colwise().normalized();
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  const fs::path file = data_ / "ct_tilted_head_phantom/I300";
  InflateBudget budget;
  std::unique_ptr<ByteSource> source;
  const auto elements = read_dicom_elements(file, "I300", budget, &source);
  const DicomInstance instance = instance_of(*elements, file, "I300", source->size());
  const SlicePlace& place = instance.image->places.at(0);
  const std::vector<float> pixels = stored("ct_tilted_head_phantom/I300");
  double sum = 0;
  int count = 0;
  for (int j = 100; j < 400; j += 3)
    for (int i = 100; i < 400; i += 3) {
      const Eigen::Vector3d lps =
          place.position + place.along_row * place.row_step * i + place.along_column * place.column_step * j;
      const Eigen::Vector3d at = image.index_to_ras_mm.inverse() * Eigen::Vector3d(-lps.x(), -lps.y(), lps.z());
      ASSERT_NEAR(at.z(), std::round(at.z()), 0.02) << "slices stay in their planes";
      ASSERT_NEAR(at.x(), std::round(at.x()), 0.02) << "nothing moves across the tilt";
      const int row = static_cast<int>(std::floor(at.y()));
      const auto value = [&](int y) {
        return static_cast<double>(image.values[image.offset(static_cast<int>(std::lround(at.x())), y,
                                                             static_cast<int>(std::lround(at.z())))]);
      };
      const double there = value(row) + (at.y() - row) * (value(row + 1) - value(row));
      const float slope = static_cast<float>(place.slope.value_or(1)),
                  intercept = static_cast<float>(place.intercept.value_or(0));
      sum += std::abs(there - static_cast<double>(slope * pixels[static_cast<std::size_t>(j * 512 + i)] + intercept));
      ++count;
    }
  std::cout << "mean difference " << sum / count << " HU\n";
  EXPECT_LT(sum / count, 12) << "interpolated twice: noise and edges are smoothed, nothing is displaced";
}

TEST_F(DicomSharedData, OtherTiltedGantryIsShearedBackToo) {
  const ImageVolume image = read_dicom_series(data_ / "bad_gantry_tilt");
  EXPECT_CONTAINS(image.notes.at(0), "tilted by 14.00 degrees");
  EXPECT_NEAR(image.index_to_ras_mm.linear().col(2).norm(), 4.851, 1e-3);
}

TEST_F(DicomSharedData, SagittalMrHasItsPatientAxes) {
  const ImageVolume image = read_dicom_series(data_ / "mr_ge_sagittal");
  EXPECT_EQ(image.size, (std::array<int, 3>{4, 256, 256}));
  for (int axis = 0; axis < 3; ++axis) EXPECT_GT(image.index_to_ras_mm.linear()(axis, axis), 0.9);
}

TEST_F(DicomSharedData, BadSeriesAreRefusedWithTheReason) {
  EXPECT_CONTAINS(refusal("bad_slice_increment"), "a gap of 10 mm where slices are 5 mm apart: 1 slice is missing");
  EXPECT_CONTAINS(refusal("bad_slice_orientation"), "holds 2 series of images; choose one with --series N");
  EXPECT_CONTAINS(refusal("single_small/CT_small.dcm"), "is a single image of 128 x 128 pixels");
  EXPECT_CONTAINS(refusal("single_small/rtstruct.dcm"), "holds no series of images");
}

TEST_F(DicomSharedData, MalformedFilesAreRefusedWithTheReason) {
  EXPECT_CONTAINS(refusal("malformed/MR_truncated.dcm"), "pixel data are cut off: 8130 of 8192 bytes");
  EXPECT_CONTAINS(refusal("malformed/badVR.dcm"), "holds no series of images; it holds\n  1: RTDOSE");
  EXPECT_CONTAINS(refusal("malformed/no_meta.dcm"), "is not a DICOM file");
  EXPECT_CONTAINS(refusal("malformed/image_dfl.dcm"), "no usable ImagePositionPatient");
  EXPECT_CONTAINS(refusal("malformed/reportsi.dcm"), "holds no series of images; it holds\n  1: SR");
  EXPECT_CONTAINS(refusal("malformed/rtplan_truncated.dcm"), "damaged DICOM: the file ends inside the value");
  EXPECT_CONTAINS(refusal("malformed/MANIFEST.md"), "is not a DICOM file");
}

TEST_F(DicomSharedData, DicomdirsListTheirSeries) {
  const auto as_folder = list_dicom(data_ / "dicomdir_study");
  EXPECT_EQ(as_folder.size(), 9U);
  for (const char* name : {"DICOMDIR", "DICOMDIR-bigEnd"}) {
    const auto list = list_dicom(data_ / "dicomdir_study" / name);
    ASSERT_EQ(list.size(), as_folder.size());
    for (std::size_t n = 0; n < list.size(); ++n) EXPECT_EQ(describe(list[n]), describe(as_folder[n]));
  }
  const ImageVolume image = read_dicom_series(data_ / "dicomdir_study/DICOMDIR", 2);
  EXPECT_EQ(image.size, (std::array<int, 3>{16, 16, 5}));
  EXPECT_CONTAINS(image.notes.at(0), "names 31 files, of which 10 are not there");
  EXPECT_CONTAINS(refusal("dicomdir_study/DICOMDIR-empty.dcm"), "names 0 files");
  EXPECT_CONTAINS(refusal("dicomdir_study/DICOMDIR-nooffset"), "or give the folder in which the DICOMDIR lies");
}

/// Filled voxels against the polygons' own areas.
TEST_F(DicomSharedData, StructureSetsHaveTheirPolygonsVolumes) {
  const fs::path file = data_ / "rtstruct_phantom/invalid_reference_rt.dcm";
  const LabelMap map = read_rtstruct(file);
  const auto structures = read_structures(DicomStudy(file), {});
  ASSERT_EQ(structures.size(), map.segments.size());
  for (std::size_t n = 0; n < structures.size(); ++n) {
    double area = 0;
    for (const Contour& contour : structures[n].closed) {
      PlaneContour flat;
      for (const Eigen::Vector3d& point : contour) flat.emplace_back(point.x(), point.y());
      area += contour_area(flat);
    }
    const LabelVolume& layer = map.layers[map.segments[n].layer];
    const double filled =
        static_cast<double>(layer.label_counts().at(map.segments[n].number)) * layer.voxel_volume_ml() * 1000;
    EXPECT_NEAR(filled / (5 * area), 1, 0.01) << structures[n].name << ": planes 5 mm apart";
  }
  EXPECT_EQ(map.segments[0].name, "ROI-1");
}

TEST_F(DicomSharedData, StructureSetsFillTheirImages) {
  const ImageVolume image = read_dicom_series(data_ / "rtstruct_phantom");
  const LabelMap hollow = read_rtstruct(data_ / "rtstruct_phantom/rt.dcm", image);
  const double area = static_cast<double>(hollow.layers[0].label_counts().at(1)) * 0.488281 * 0.488281;
  EXPECT_NEAR(area, 24 * 24 - 224.5, 0.5 * 0.488281 * (4 * 24 + 4 * 15))
      << "a square with a hole, to half a pixel along its edges";
  const LabelMap tall = read_rtstruct(data_ / "rtstruct_phantom/invalid_reference_rt.dcm", image);
  EXPECT_CONTAINS(tall.notes.at(0), "lie outside the grid and were left out: it is cut there");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_rtstruct(data_ / "single_small/rtstruct.dcm", image); }),
                  "belongs to another series");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_rtstruct(data_ / "rtstruct_phantom/rt.dcm"); }),
                  "lie in a single plane");
  EXPECT_EQ(read_rtstruct(data_ / "single_small/rtstruct.dcm").layers[0].label_counts().at(1), 360000U)
      << "400 x 300 x 3 voxels";
}

TEST_F(DicomSharedData, NothingIsPrinted) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  std::string text;
  for (const auto& entry : fs::directory_iterator(data_))
    for (const DicomSeries& series : list_dicom(entry.path())) {
      text += describe(series) + series.problem;
      try {
        if (series.kind == DicomKind::kImage) read_dicom_series(entry.path(), series.number);
        if (series.kind == DicomKind::kSegmentation) read_dicom_segmentation(entry.path(), {}, series.number);
      } catch (const InputError& error) {
        text += error.what();
      }
    }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  for (const char* name : {"JANCT", "Doe^", "PHANTOM_EXAMPLE", "1.2.840.", "1.3.6.1.4"})
    EXPECT_EQ(text.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace trocar::test::dicom_shared_data_test
