// The phantom's DICOM series as another library reads it (dcmtk).
#include "tissue/imaging/phantom/dicom_writer.h"

#include <gtest/gtest.h>

#include <dcmtk/dcmdata/dctk.h>

#include <set>

#include "haptics/input_error.h"
#include "tests/tissue/support/temporary_folder.h"

namespace trocar::dicom_writer_test {
namespace {

const CtPhantom& phantom() {
  static const CtPhantom made = make_phantom({.voxel_mm = 10});
  return made;
}

class PhantomDicom : public ::testing::Test {
 protected:
  void SetUp() override { write_phantom_dicom(folder_ / "series", phantom()); }

  std::filesystem::path slice(int k) const {
    char name[32];
    std::snprintf(name, sizeof name, "slice-%04d.dcm", k + 1);
    return folder_ / "series" / name;
  }
  DcmFileFormat loaded(int k) const {
    DcmFileFormat file;
    const OFCondition outcome = file.loadFile(slice(k).c_str());
    EXPECT_TRUE(outcome.good()) << outcome.text();
    return file;
  }
  static std::string text(DcmFileFormat& file, const DcmTagKey& tag) {
    OFString value;
    EXPECT_TRUE(file.getDataset()->findAndGetOFStringArray(tag, value).good()) << tag.toString();
    return value.c_str();
  }

  test::TemporaryFolder folder_;
};

TEST_F(PhantomDicom, EverySliceIsACtImageOfOneSeries) {
  std::set<std::string> instances, series, frames;
  for (int k = 0; k < phantom().labels.size[2]; ++k) {
    DcmFileFormat file = loaded(k);
    EXPECT_EQ(text(file, DCM_SOPClassUID), UID_CTImageStorage);
    EXPECT_EQ(text(file, DCM_Modality), "CT");
    EXPECT_EQ(file.getDataset()->getOriginalXfer(), EXS_LittleEndianExplicit);
    instances.insert(text(file, DCM_SOPInstanceUID));
    series.insert(text(file, DCM_SeriesInstanceUID));
    frames.insert(text(file, DCM_FrameOfReferenceUID));
    OFString meta;
    EXPECT_TRUE(file.getMetaInfo()->findAndGetOFString(DCM_MediaStorageSOPInstanceUID, meta).good());
    EXPECT_EQ(std::string(meta.c_str()), text(file, DCM_SOPInstanceUID));
  }
  EXPECT_EQ(instances.size(), static_cast<std::size_t>(phantom().labels.size[2]));
  EXPECT_EQ(series.size(), 1U);
  EXPECT_EQ(frames.size(), 1U);
  for (const std::string& uid : instances) EXPECT_LE(uid.size(), 64U);
}

TEST_F(PhantomDicom, PixelsAndPlacesAreThoseOfTheVolume) {
  const LabelVolume& grid = phantom().labels;
  for (const int k : {0, 7, grid.size[2] - 1}) {
    DcmFileFormat file = loaded(k);
    DcmDataset& set = *file.getDataset();
    Uint16 rows = 0, columns = 0;
    const Uint16* stored = nullptr;
    unsigned long count = 0;
    Float64 slope = 0, intercept = 0, corner[3] = {}, spacing[2] = {};
    set.findAndGetUint16(DCM_Rows, rows), set.findAndGetUint16(DCM_Columns, columns);
    set.findAndGetUint16Array(DCM_PixelData, stored, &count);
    set.findAndGetFloat64(DCM_RescaleSlope, slope), set.findAndGetFloat64(DCM_RescaleIntercept, intercept);
    for (unsigned long n = 0; n < 3; ++n) set.findAndGetFloat64(DCM_ImagePositionPatient, corner[n], n);
    for (unsigned long n = 0; n < 2; ++n) set.findAndGetFloat64(DCM_PixelSpacing, spacing[n], n);
    ASSERT_EQ(rows, grid.size[1]);
    ASSERT_EQ(columns, grid.size[0]);
    ASSERT_EQ(count, static_cast<unsigned long>(rows) * columns);
    EXPECT_EQ(text(file, DCM_ImageOrientationPatient), "1\\0\\0\\0\\1\\0");
    for (int r = 0; r < rows; r += 3)
      for (int c = 0; c < columns; c += 3) {
        // Rows and columns of this orientation step along +y and +x of the LPS frame, which is RAS with x and y turned.
        const Eigen::Vector3d ras(-(corner[0] + spacing[1] * c), -(corner[1] + spacing[0] * r), corner[2]);
        const Eigen::Vector3d index = grid.index_to_ras_mm.inverse() * ras;
        const std::size_t at =
            grid.offset(static_cast<int>(std::lround(index.x())), static_cast<int>(std::lround(index.y())),
                        static_cast<int>(std::lround(index.z())));
        EXPECT_NEAR((index - index.array().round().matrix()).norm(), 0, 1e-6);
        EXPECT_EQ(stored[r * columns + c] * slope + intercept, phantom().hounsfield[at]);
      }
  }
}

TEST_F(PhantomDicom, TagsAscendAndValuesFitTheirRepresentation) {
  DcmFileFormat file = loaded(3);
  DcmDataset& set = *file.getDataset();
  DcmTagKey before(0, 0);
  for (unsigned long n = 0; n < set.card(); ++n) {
    DcmElement* element = set.getElement(n);
    EXPECT_TRUE(before < element->getTag()) << element->getTag().toString();
    before = element->getTag();
    EXPECT_TRUE(element->getVR() == EVR_OW || element->checkValue("1-n", OFTrue).good())
        << element->getTag().toString();
    EXPECT_EQ(element->getLength() % 2, 0U);
  }
  EXPECT_EQ(text(file, DCM_PatientName), "PHANTOM");
  EXPECT_EQ(text(file, DCM_PatientID), "PHANTOM");
}

TEST_F(PhantomDicom, SamePhantomSameBytesAndAnotherHasOtherIdentifiers) {
  EXPECT_EQ(phantom_dicom_slice(phantom(), 2), phantom_dicom_slice(make_phantom({.voxel_mm = 10}), 2));
  const CtPhantom other = make_phantom({.voxel_mm = 10, .seed = 2});
  write_phantom_dicom(folder_ / "other", other);
  DcmFileFormat first = loaded(0), second;
  ASSERT_TRUE(second.loadFile((folder_ / "other" / "slice-0001.dcm").c_str()).good());
  EXPECT_NE(text(first, DCM_SeriesInstanceUID), text(second, DCM_SeriesInstanceUID));
}

TEST_F(PhantomDicom, NothingStaysWhereTheFolderCannotBe) {
  const auto blocked = folder_.write("file", "x");
  EXPECT_THROW(write_phantom_dicom(blocked / "series", phantom()), EnvironmentError);
  CtPhantom bad = phantom();
  bad.hounsfield.back() = 4000;
  EXPECT_THROW(write_phantom_dicom(folder_ / "bad", bad), std::invalid_argument);
  std::size_t left = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "bad"))
    left += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(left, 0U);
}

}  // namespace
}  // namespace trocar::dicom_writer_test
