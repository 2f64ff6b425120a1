// Labels on a grid unlike the image's, and DICOM that is looked at once: what an import starts from.
#include <gtest/gtest.h>

#include <sstream>

#include "app/organs/import_source.h"
#include "app/organs/organ_import.h"
#include "app/organs/slice_picture.h"
#include "haptics/input_error.h"
#include "tests/tissue/imaging/dicom/segmentation_fixture.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/organ_compiler.h"
#include "tissue/organ/organ_manifest.h"

namespace trocar::organ_grids_test {
namespace {

const Vec3 kBall(14, -9, 6);  // mm, RAS: a shift, a turn or a mirror between the grids would show
constexpr double kRadius = 30;

template <typename Value>
std::string volume_of(const std::array<int, 3>& size, const Eigen::Affine3d& frame, double radius, Value inside,
                      Value outside) {
  std::vector<Value> values;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        values.push_back((frame * Vec3(i, j, k) - kBall).norm() < radius ? inside : outside);
  return nifti_gz_bytes(size, frame, values);
}

Eigen::Affine3d frame_of(const Eigen::Matrix3d& axes, const Eigen::Vector3d& spacing, const std::array<int, 3>& size,
                         const Vec3& centre) {
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = axes * spacing.asDiagonal();
  frame.translation() = centre - frame.linear() * (0.5 * (Vec3(size[0], size[1], size[2]) - Vec3::Ones()));
  return frame;
}

/// An image of 3 x 3 x 4 mm, and labels of 2 x 1.5 x 1.7 mm, turned by 35 degrees about an oblique axis and shifted.
struct Grids {
  test::TemporaryFolder folder;
  OrganImportOptions options;

  explicit Grids(double label_radius, const Vec3& label_centre = kBall + Vec3(3.3, -2.1, 1.7)) {
    const std::array<int, 3> coarse{44, 46, 34}, fine{46, 60, 54};
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.61, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const auto image_frame = frame_of(Eigen::Matrix3d::Identity(), {3, 3, 4}, coarse, {4, 4, 4});
    const auto label_frame = frame_of(turn, {2, 1.5, 1.7}, fine, label_centre);
    options.input =
        folder.write("ct.nii.gz", volume_of<std::int16_t>(coarse, image_frame, kRadius, 100, -900)).string();
    options.labels =
        folder.write("ball.nii.gz", volume_of<std::uint16_t>(fine, label_frame, label_radius, 1, 0)).string();
    options.output = (folder / "ball").string();
    options.triangles = 1500;
    options.json = true;
  }
};

TEST(GridsThatDiffer, OutlinesLieOnTheEdgeThatTheImageShows) {
  Grids grids(kRadius);
  const ImportSource source = read_import_source(grids.options);
  ASSERT_EQ(source.on_image.size(), 1U);
  const CompiledOrgan organ = compile_label(source.map.layers[0], 1, {1500, {}, {}});
  for (const SlicePlane plane : {SlicePlane::kAxial, SlicePlane::kCoronal, SlicePlane::kSagittal}) {
    constexpr int kPixels = 300;
    const Image ground = slice_picture({&*source.image, nullptr}, {}, plane, kBall, 100, kPixels);
    const Image drawn =
        slice_picture({&*source.image, nullptr}, {{&organ.surface, Colour{255, 0, 0, 1}}}, plane, kBall, 100, kPixels);
    int red = 0, astray = 0;
    for (int y = 30; y < kPixels - 30; ++y)
      for (int x = 30; x < kPixels - 30; ++x) {
        const std::uint8_t* pixel = drawn.pixel(x, y);
        if (pixel[0] < 200 || pixel[1] > 60) continue;
        ++red;
        bool dark = false, light = false;  // within the longest voxel edge of the image, 4 mm: both sides of the edge
        for (int dy = -12; dy <= 12; ++dy)
          for (int dx = -12; dx <= 12; ++dx) (ground.pixel(x + dx, y + dy)[0] > 100 ? light : dark) = true;
        astray += dark && light ? 0 : 1;
      }
    EXPECT_GT(red, 2 * 3.14 * 90 * 0.8);  // a circle of 90 pixels' radius
    EXPECT_EQ(astray, 0);
  }
}

TEST(GridsThatDiffer, TheSurfaceIsThatOfTheLabelsOwnGrid) {
  Grids grids(kRadius);
  const ImportSource source = read_import_source(grids.options);
  EXPECT_EQ(source.map.layers[0].size, (std::array<int, 3>{46, 60, 54}));
  const CompiledOrgan organ = compile_label(source.map.layers[0], 1, {3000, {}, {}});
  double worst = 0;
  for (const Vec3& vertex : organ.surface.vertices)
    worst = std::max(worst, std::abs(1e3 * (vertex - 1e-3 * kBall).norm() - kRadius));
  EXPECT_LT(worst, 1.7) << "mm; the image's own voxels are 3 x 3 x 4 mm";
}

TEST(GridsThatDiffer, ImageValuesUnderTheLabelGoThroughThePatient) {
  Grids grids(kRadius - 5);  // well inside what the image shows: nothing but 100
  grids.options.report = grids.folder / "page.html", grids.options.material = "soft_tissue";
  std::ostringstream out, err;
  EXPECT_EQ(organ_import(grids.options, out, err), 0);
  EXPECT_CONTAINS(err.str(), "the labels have another grid than the image; surfaces are made on the labels' own grid");
  EXPECT_CONTAINS(read_bytes(grids.options.report),
                  "mean 100.0 HU, standard deviation 0.0 HU, 90 % between 100 and 100 HU");
  const LabelValues values = image_values(read_import_source(grids.options), {0, 1, ""});
  EXPECT_NEAR(static_cast<double>(values.voxels) * 36e-3, 4.0 / 3 * M_PI * std::pow(2.5, 3), 1.5);  // mL
}

TEST(GridsThatDiffer, LabelsBesideTheImageAreRefusedThoughTheGridsMeet) {
  Grids grids(kRadius);
  const std::array<int, 3> size{120, 40, 40};  // reaches into the image, but its ball lies 5 cm outside it
  std::vector<std::uint16_t> labels;
  const auto frame = frame_of(Eigen::Matrix3d::Identity(), {3, 3, 3}, size, {150, 0, 0});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 120; ++i) labels.push_back((frame * Vec3(i, j, k) - Vec3(140, 0, 0)).norm() < 20 ? 1 : 0);
  grids.options.labels = grids.folder.write("far.nii.gz", nifti_gz_bytes(size, frame, labels)).string();
  const std::string message = test::message_of<InputError>([&] { read_import_source(grids.options); });
  EXPECT_CONTAINS(message, "far.nii.gz: the label map lies ");
  EXPECT_CONTAINS(message, "mm outside the image: not its labels");
}

int looked_at(const std::filesystem::path& input, bool labels, std::string& message) {
  OrganImportOptions options;
  options.input = input.string();
  int count = 0;
  options.progress = [&](std::string_view stage, double share) {
    count += stage == "looking at the files" && share == 0 ? 1 : 0;
  };
  if (labels) {
    const ImportSource source = read_import_source(options);
    EXPECT_TRUE(source.image && source.map.segments.size() == 1);
  } else {
    message = test::message_of<InputError>([&] { read_import_source(options); });
  }
  return count;
}

TEST(DicomFolder, IsLookedThroughOnce) {
  test::TemporaryFolder folder;
  const auto slices = test::stack_of(4, 2);
  for (std::size_t n = 0; n < slices.size(); ++n) folder.write("a" + std::to_string(n), slices[n].file());
  std::string message;
  EXPECT_EQ(looked_at(folder.path(), false, message), 1);
  EXPECT_CONTAINS(message, "holds DICOM images and no labels");
  test::SegmentationFixture marked;
  for (int k = 0; k < 4; ++k)
    marked.frames.push_back({1, slices[0].position + Eigen::Vector3d(0, 0, 2 * k),
                             std::vector<int>(static_cast<std::size_t>(marked.columns * marked.rows), 1)});
  folder.write("seg", marked.file());
  EXPECT_EQ(looked_at(folder.path(), true, message), 1);
}

TEST(DicomFolder, DamagedFilesAndReportsAreNamedForWhatTheyAre) {
  test::TemporaryFolder folder;
  std::string message;
  const std::string whole = test::stack_of(1, 1)[0].file();
  looked_at(folder.write("cut.dcm", whole.substr(0, whole.size() - 20)), false, message);
  EXPECT_CONTAINS(message, "cut.dcm");
  EXPECT_CONTAINS(message, "cut off");
  test::SliceFixture report;
  report.sop_class = "1.2.840.10008.5.1.4.1.1.88.11", report.modality = "SR";
  report.change = [](test::Elements& elements) { elements.erase(0x7FE00010).erase(0x00280010).erase(0x00280011); };
  looked_at(folder.write("sr.dcm", report.file()), false, message);
  EXPECT_EQ(message.find("--threshold"), std::string::npos) << message;
  EXPECT_CONTAINS(message, "report");
}

}  // namespace
}  // namespace trocar::organ_grids_test
