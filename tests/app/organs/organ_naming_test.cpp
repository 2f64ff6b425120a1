// Right name or none: what files say about their labels, one mask an organ, several surfaces; and what the console
// tells.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/organs/organ_files.h"
#include "app/organs/organ_import.h"
#include "app/organs/organ_inspect.h"
#include "app/organs/zip_writer.h"
#include "haptics/input_error.h"
#include "tests/tissue/support/nifti_fixture.h"
#include "tests/tissue/support/shapes.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/imaging/volumes/gzip_stream.h"
#include "tissue/imaging/volumes/nifti_writer.h"
#include "tissue/organ/organ.h"

namespace trocar::organ_naming_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Two half balls, `low` below and `high` above; a number 0 marks nothing.
LabelVolume halves(std::uint16_t low, std::uint16_t high) {
  LabelVolume volume = test::ball_volume(24, 3, {0, 0, 0}, 30);
  for (std::size_t n = 0; n < volume.labels.size(); ++n)
    if (volume.labels[n] != 0) volume.labels[n] = n < volume.labels.size() / 2 ? low : high;
  return volume;
}

std::string nifti(const LabelVolume& volume) {
  return nifti_gz_bytes(volume.size, volume.index_to_ras_mm, volume.labels);
}

/// As TotalSegmentator writes with --ml: a label table as an extension of code 0, padded with blanks.
std::string nifti_with_names(const LabelVolume& volume, const std::string& labels) {
  test::NiftiFixture fixture(volume.size, volume.index_to_ras_mm);
  std::copy(volume.labels.begin(), volume.labels.end(), fixture.voxels.begin());
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?> <CaretExtension>  <Date><![CDATA[2013-07-14]]></Date>"
      "<VolumeInformation Index=\"0\"><LabelTable>\n" +
      labels +
      "</LabelTable><VolumeType><![CDATA[Label]]></VolumeType></VolumeInformation>"
      "</CaretExtension>\n              ";
  xml.resize((xml.size() + 8 + 15) / 16 * 16 - 8, '\0');
  fixture.header[348] = 1;
  fixture.put(108, static_cast<float>(352 + 8 + xml.size()));
  const std::array<std::int32_t, 2> lead{static_cast<std::int32_t>(xml.size() + 8), 0};
  return gzip_compressed(fixture.header + std::string(reinterpret_cast<const char*>(lead.data()), 8) + xml +
                         std::string(fixture.voxels.begin(), fixture.voxels.end()));
}

std::string label(int key, const std::string& name) {
  return "<Label Key=\"" + std::to_string(key) +
         "\" Red=\"1.0\" Green=\"0.5019607843137255\" Blue=\"0.0\" Alpha=\"1\"><![CDATA[" + name + "]]></Label>\n";
}

/// A segmentation of 3 D Slicer. @param swapped the numbers of liver and spleen change places, and so do the voxels'
std::string seg_nrrd(bool swapped) {
  const LabelVolume volume = swapped ? halves(1, 5) : halves(5, 1);
  const std::string liver = swapped ? "1" : "5", spleen = swapped ? "5" : "1";
  std::string bytes(volume.labels.size(), '\0');
  std::copy(volume.labels.begin(), volume.labels.end(), bytes.begin());
  return "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: right-anterior-superior\nsizes: 24 24 24\n"
         "space directions: (3,0,0) (0,3,0) (0,0,3)\nkinds: domain domain domain\nencoding: gzip\n"
         "space origin: (-34.5,-34.5,-34.5)\n"
         "Segment0_Name:=Liver\nSegment0_LabelValue:=" +
         liver +
         "\nSegment0_Layer:=0\nSegment0_Color:=0.8 0.4 0.2\n"
         "Segment0_Tags:=Segmentation.Status:inprogress|TerminologyEntry:Segmentation category and type~"
         "SCT^123037004^Anatomical Structure~SCT^10200004^Liver~^^~Anatomic codes~^^~^^|\n"
         "Segment1_Name:=Segment_2\nSegment1_LabelValue:=" +
         spleen +
         "\nSegment1_Layer:=0\n"
         "Segment1_Tags:=TerminologyEntry:Segmentation category and type~SCT^123037004^Anatomical Structure~"
         "SCT^78961009^Spleen~^^~Anatomic codes~^^~^^|\n\n" +
         gzip_compressed(bytes);
}

struct Trial {
  test::TemporaryFolder folder;
  OrganImportOptions options;

  explicit Trial(const std::string& input = "") {
    options.input = (folder / input).string();
    options.output = (folder / "out").string();
    options.triangles = 600, options.json = true;
  }
  Json imported() {
    std::ostringstream out, err;
    EXPECT_EQ(organ_import(options, out, err), 0);
    return Json::parse(out.str());
  }
  std::string refusal() {
    std::ostringstream out, err;
    return test::message_of<InputError>([&] { organ_import(options, out, err); });
  }
};

TEST(OrganNaming, TheLabelTableInANiftiNamesItsNumbers) {
  Trial trial("seg.nii.gz");
  trial.folder.write("seg.nii.gz", nifti_with_names(halves(4, 1), label(1, "aorta") + label(4, "celiac_trunk") +
                                                                      label(5, "liver") + label(6, "stomach")));
  trial.options.all = true;
  const Json report = trial.imported();
  ASSERT_EQ(report["organs"].size(), 2U);
  EXPECT_EQ(report["organs"][0]["name"], "aorta") << "1 is the spleen in every built-in table";
  EXPECT_EQ(report["organs"][1]["name"], "celiac_trunk") << "4 is the gallbladder in TotalSegmentator's";
  EXPECT_EQ(report["organs"][0]["material"], "aorta");
  EXPECT_EQ(report["organs"][0]["source"]["label_table"], "");
  EXPECT_EQ(report["organs"][0]["source"]["label_colour"], Json({255, 128, 0}));
  EXPECT_CONTAINS(report["organs"][0]["repairs"].dump(), "segments \\\"liver\\\", \\\"stomach\\\" mark no voxel");
  trial.options.label_table = "totalsegmentator-v2";
  EXPECT_CONTAINS(trial.refusal(), "label 1 is \"aorta\" by the file's own names and \"spleen\" in the table");
  trial.options.label_table = trial.folder.write("own.csv", "1,celiac_trunk\n4,aorta\n").string();
  const Json own = trial.imported();
  EXPECT_EQ(own["organs"][0]["name"], "celiac_trunk") << "the user's own words go first";
  EXPECT_EQ(own["organs"][0]["source"]["label_table"], "own.csv");
  EXPECT_CONTAINS(own["organs"][0]["decisions"].dump() + own["organs"][0]["repairs"].dump(), "the file calls it");
}

TEST(OrganNaming, ADamagedOrAmbiguousTableNamesNothing) {
  Trial trial("seg.nii.gz");
  trial.options.all = true;
  trial.folder.write("seg.nii.gz", nifti_with_names(halves(4, 1), label(1, "aorta") + "<Label Key="));
  EXPECT_CONTAINS(trial.refusal(), "labels 1, 4 have no name in the file");
  trial.folder.write("seg.nii.gz",
                     nifti_with_names(halves(4, 1), label(1, "aorta") + label(1, "liver") + label(4, "spleen")));
  EXPECT_CONTAINS(trial.refusal(), "label 1 has no name in the file");
}

TEST(OrganNaming, SwappedNumbersInASegNrrdChangeNothing) {
  for (const bool swapped : {false, true}) {
    Trial trial("SEG.NRRD");
    trial.folder.write("SEG.NRRD", seg_nrrd(swapped));
    trial.options.label = {"liver"};
    const Json report = trial.imported();
    EXPECT_EQ(report["name"], "liver");
    EXPECT_EQ(report["material"], "liver");
    EXPECT_LT(report["bbox_m"][0][2].get<double>(), -0.02) << "the lower half";
    EXPECT_EQ(report["source"]["label_name"], "Liver");
    EXPECT_EQ(report["source"]["label_colour"], Json({204, 102, 51}));
    EXPECT_EQ(report["source"]["label_codes"][1],
              (Json{{"role", "type"}, {"scheme", "SCT"}, {"value", "10200004"}, {"meaning", "Liver"}}));
  }
}

TEST(OrganNaming, ACodeGivesTheMaterialThatTheNameDoesNot) {
  Trial trial("seg.nrrd");
  trial.folder.write("seg.nrrd", seg_nrrd(false));
  trial.options.label = {"Segment_2"};
  const Json report = trial.imported();
  EXPECT_EQ(report["name"], "segment_2");
  EXPECT_EQ(report["material"], "spleen");
  EXPECT_CONTAINS(report["decisions"].dump(), "by the file's code SCT 78961009");
  const OrganManifest read = parse_manifest(read_bytes(trial.folder / "out.organ.toml"), "out");
  ASSERT_EQ(read.source.codes.size(), 2U);
  EXPECT_EQ(read.source.codes[1].meaning, "Spleen");
}

TEST(OrganNaming, SegmentsWithoutNumbersNameNothing) {
  Trial trial("seg.nrrd");
  std::string text = seg_nrrd(false);
  for (const std::string& line : {std::string("Segment0_LabelValue:=5\n"), std::string("Segment1_LabelValue:=1\n")})
    text.erase(text.find(line), line.size());
  trial.folder.write("seg.nrrd", text);
  trial.options.all = true;
  EXPECT_CONTAINS(trial.refusal(), "labels 1, 5 have no name in the file");
}

TEST(OrganNaming, ALoneSegmentWithoutItsNumberNamesNothing) {
  Trial trial("seg.nrrd");
  std::string text = seg_nrrd(false);
  const std::string line = "Segment0_LabelValue:=5\n";
  text.erase(text.find(line), line.size());
  text.erase(text.find("Segment1_Name"), text.find("\n\n") + 1 - text.find("Segment1_Name"));
  trial.folder.write("seg.nrrd", text);
  trial.options.all = true;
  EXPECT_CONTAINS(trial.refusal(), "labels 1, 5 have no name in the file");
}

TEST(OrganNaming, MaterialsAreAskedForAndMustExist) {
  Trial trial("case7.nii.gz");
  trial.folder.write("case7.nii.gz", nifti(halves(5, 5)));
  EXPECT_CONTAINS(trial.refusal(), "label 5 has no name in the file");
  trial.options.material = "velvet";
  EXPECT_CONTAINS(trial.refusal(), "--material velvet: no such material; there are soft_tissue, liver");
  trial.options.material = "Liver";
  EXPECT_EQ(trial.imported()["material"], "liver");
  trial.options.material.clear(), trial.options.output = (trial.folder / "Spleen.organ.toml").string();
  const Json report = trial.imported();
  EXPECT_EQ(report["name"], "Spleen") << "the user's own word";
  EXPECT_EQ(report["material"], "spleen");
}

/// One mask an organ, as TotalSegmentator writes by default; most mark nothing.
void write_masks(const fs::path& folder, std::map<std::string, std::string>& files) {
  files["s/liver.nii.gz"] = nifti(halves(1, 0)), files["s/spleen.nii.gz"] = nifti(halves(0, 1));
  files["s/heart.nii.gz"] = files["s/brain.nii.gz"] = nifti(halves(0, 0));
  files["s/statistics.json"] = "{}";
  fs::create_directories(folder / "s");
  for (const auto& [name, bytes] : files) std::ofstream(folder / name, std::ios::binary) << bytes;
}

TEST(OrganFileSets, AFolderAndAZipOfMasksAreOneScene) {
  std::map<std::string, std::string> files;
  Trial trial("s");
  write_masks(trial.folder.path(), files);
  const Json from_folder = trial.imported();
  ASSERT_EQ(from_folder["organs"].size(), 2U);
  EXPECT_EQ(from_folder["organs"][0]["name"], "liver");
  EXPECT_EQ(from_folder["organs"][0]["source"]["file"], "liver.nii.gz");
  EXPECT_EQ(from_folder["organs"][0]["source"]["label"], 1);
  EXPECT_EQ(from_folder["contacts"].size(), 1U) << "they lie against each other";
  EXPECT_CONTAINS(from_folder["organs"][0]["repairs"].dump(), "2 masks mark no voxel and were left out: brain, heart");
  trial.folder.write("masks.zip", zip_bytes(files));
  trial.options.input = (trial.folder / "masks.zip").string();
  EXPECT_EQ(trial.imported(), from_folder);
  trial.options.name = "spleen";
  const Json one = trial.imported();
  EXPECT_EQ(one["name"], "spleen");
  EXPECT_GT(one["bbox_m"][1][2].get<double>(), 0.02);
  trial.options.name = "splen";
  EXPECT_CONTAINS(trial.refusal(),
                  "no file of \"splen\"; did you mean \"spleen\"?; it holds brain, heart, liver, spleen");
  EXPECT_CONTAINS(trial.refusal(), "--all --name splen");
  trial.options.all = true;
  EXPECT_EQ(trial.imported()["organs"].size(), 2U);
  trial.options.all = false;
  trial.options.name.clear(), trial.options.label = {"kidney"};
  EXPECT_CONTAINS(trial.refusal(), "holds no file of \"kidney\"; it holds brain, heart, liver, spleen");
}

TEST(OrganFileSets, WhereMasksOverlapTheSmallerHasThePlace) {
  std::map<std::string, std::string> files;
  Trial trial("s");
  write_masks(trial.folder.path(), files);
  const Json apart = trial.imported();
  trial.folder.write("s/liver.nii.gz", nifti(halves(1, 1)));
  const Json over = trial.imported();
  EXPECT_EQ(over["organs"].size(), 2U);
  EXPECT_EQ(over["contacts"], apart["contacts"]) << "they share a border and do not cross";
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(over["organs"][n]["bbox_m"], apart["organs"][n]["bbox_m"]);
  trial.options.name = "liver";
  const double alone_m = trial.imported()["bbox_m"][1][2].get<double>();
  EXPECT_GT(alone_m, apart["organs"][0]["bbox_m"][1][2].get<double>() + 0.02) << "by itself it is whole";
}

TEST(OrganFileSets, MasksCutOutOfOneGridAreLaidOnIt) {
  Trial trial("s");
  std::map<std::string, std::string> files;
  write_masks(trial.folder.path(), files);
  const Json whole = trial.imported();
  LabelVolume upper = halves(0, 1);  // as 3D Slicer exports it: the slices with something in them
  const std::size_t below = upper.offset(0, 0, 10);
  upper.labels.erase(upper.labels.begin(), upper.labels.begin() + static_cast<std::ptrdiff_t>(below));
  upper.size[2] -= 10, upper.index_to_ras_mm.translation() = upper.index_to_ras_mm * Eigen::Vector3d(0, 0, 10);
  trial.folder.write("s/spleen.nii.gz", nifti(upper));
  const Json cut_out = trial.imported();
  ASSERT_EQ(cut_out["organs"].size(), 2U);
  EXPECT_EQ(cut_out["contacts"], whole["contacts"]);
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(cut_out["organs"][n]["bbox_m"], whole["organs"][n]["bbox_m"]);
}

TEST(OrganFileSets, MasksOfAnotherGridOrOfNothingAreRefused) {
  Trial trial("a.nii.gz");
  trial.folder.write("a.nii.gz", nifti(halves(1, 0)));
  const LabelVolume other = test::ball_volume(20, 3.5, {0, 0, 0}, 20);
  trial.folder.write("b.nii.gz", nifti(other));
  trial.options.more_inputs = {(trial.folder / "b.nii.gz").string()};
  EXPECT_CONTAINS(trial.refusal(), "b.nii.gz: lies on another grid (20 x 20 x 20 voxels of 3.5 x 3.5 x 3.5 mm");
  EXPECT_CONTAINS(trial.refusal(), ") than a.nii.gz (24 x 24 x 24 voxels of 3 x 3 x 3 mm");
  trial.folder.write("b.nii.gz", "");
  EXPECT_CONTAINS(trial.refusal(), "b.nii.gz");
  trial.folder.write("a.nii.gz", nifti(halves(0, 0))), trial.folder.write("b.nii.gz", nifti(halves(0, 0)));
  EXPECT_CONTAINS(trial.refusal(), "holds no mask that marks a voxel");
}

TEST(OrganFileSets, SharesOfAnOrganAreNoImageAmongMasks) {
  Trial trial("s");
  std::map<std::string, std::string> files;
  write_masks(trial.folder.path(), files);
  const LabelVolume ball = halves(1, 1);
  test::NiftiFixture soft(ball.size, ball.index_to_ras_mm);
  for (std::size_t n = 0; n < soft.voxels.size(); ++n)
    soft.voxels[n] = static_cast<std::uint8_t>(ball.labels[n] != 0 ? n % 10 : 0);
  soft.put(112, 0.1F);  // scl_slope: 0 to 0.9
  trial.folder.write("s/soft.nii", soft.bytes());
  EXPECT_CONTAINS(trial.refusal(), "soft.nii");
  soft.put(112, 40.5F);  // values of an image
  trial.folder.write("s/soft.nii", soft.bytes());
  EXPECT_CONTAINS(trial.imported()["organs"][0]["repairs"].dump(),
                  "soft.nii is the image that the masks were drawn on");
}

TEST(OrganFileSets, AnOrganThatIsThereTwiceIsRefused) {
  Trial trial("s");
  std::map<std::string, std::string> files;
  write_masks(trial.folder.path(), files);
  trial.folder.write("s/hepar.nii.gz", files["s/liver.nii.gz"]);
  EXPECT_CONTAINS(trial.refusal(), "\"hepar\": 100 % of it is \"liver\" too");
  EXPECT_FALSE(fs::exists(trial.folder / "out.scene.toml"));
}

TEST(OrganFileSets, SeveralSurfacesAreOneScene) {
  Trial trial("Liver.ply");
  trial.folder.write("Liver.ply", test::ascii_ply(test::sphere(Vec3(0.1, 0, 0), 0.04, 3), 1e3));
  trial.folder.write("sac.ply", test::ascii_ply(test::sphere(Vec3::Zero(), 0.02, 3), 1e3));
  trial.options.more_inputs = {(trial.folder / "sac.ply").string()};
  trial.options.surface.unit = "mm";
  const Json report = trial.imported();
  ASSERT_EQ(report["organs"].size(), 2U);
  EXPECT_EQ(report["subject"], "liver");
  EXPECT_EQ(report["organs"][0]["material"], "liver");
  EXPECT_EQ(load_organ(trial.folder / "out.scene.toml").adjacent.at(0).name, "sac");
  trial.options.more_inputs.push_back((trial.folder / "none.nii.gz").string());
  EXPECT_CONTAINS(trial.refusal(), "none.nii.gz");
}

TEST(OrganConsole, SaysWhatMattersInTenLines) {
  std::map<std::string, std::string> files;
  Trial trial("s");
  write_masks(trial.folder.path(), files);
  trial.options.json = false;
  for (const char* name : {"", "liver"}) {
    trial.options.name = name;
    std::ostringstream out, err;
    EXPECT_EQ(organ_import(trial.options, out, err), 0);
    const std::string all = out.str() + err.str();
    EXPECT_LE(std::count(all.begin(), all.end(), '\n'), 10) << all;
    EXPECT_CONTAINS(all, "liver");
    EXPECT_CONTAINS(all, "trocar organ info ");
  }
}

}  // namespace
}  // namespace trocar::organ_naming_test
