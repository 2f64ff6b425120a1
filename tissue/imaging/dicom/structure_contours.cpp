#include "tissue/imaging/dicom/structure_contours.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmrt/drtstrct.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/dcmtk_silence.h"
#include "tissue/imaging/dicom/dicom_catalogue.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/packed_bytes.h"

namespace trocar {
namespace {

constexpr double kFarthestContour = 1e5;  // mm
constexpr std::uint64_t kMostBytes = std::uint64_t{512} << 20;

std::string printable(const OFString& name) {
  std::string text(name.c_str());
  for (char& letter : text)
    if (std::iscntrl(static_cast<unsigned char>(letter)) != 0) letter = ' ';
  return text.substr(0, 64);
}

bool closed(const DRTContourSequence::Item& contour) {
  OFString type;
  contour.getContourGeometricType(type);
  return type == "CLOSED_PLANAR" || type == "CLOSEDPLANAR_XOR";
}

void pack_contour(PackedWriter& out, DRTContourSequence::Item& contour) {
  OFVector<Float64> numbers;
  const bool usable = closed(contour) && contour.getContourData(numbers).good() && numbers.size() >= 9;
  if (usable && numbers.size() % 3 != 0) throw std::runtime_error("a contour whose numbers are not triples");
  const std::size_t points = usable ? numbers.size() / 3 : 0;
  out.put(static_cast<std::uint64_t>(points));
  for (std::size_t n = 0; n < 3 * points; ++n) out.put(static_cast<double>(numbers[n]));
}

void pack_structure(PackedWriter& out, DRTROIContourSequence::Item& item, const std::map<int, std::string>& names) {
  Sint32 number = 0;
  item.getReferencedROINumber(number);
  const auto name = names.find(number);
  DRTContourSequence& contours = item.getContourSequence();
  out.put(static_cast<std::int32_t>(number));
  out.put_text(name != names.end() ? name->second : "");
  out.put(static_cast<std::uint64_t>(contours.getNumberOfItems()));
  for (std::size_t n = 0; n < contours.getNumberOfItems(); ++n) pack_contour(out, contours.getItem(n));
}

std::map<int, std::string> names_of(DRTStructureSetIOD& set) {
  std::map<int, std::string> names;
  DRTStructureSetROISequence& list = set.getStructureSetROISequence();
  for (std::size_t n = 0; n < list.getNumberOfItems(); ++n) {
    Sint32 number = 0;
    OFString name;
    list.getItem(n).getROINumber(number);
    list.getItem(n).getROIName(name);
    names.try_emplace(number, printable(name));
  }
  return names;
}

std::string load_structures(const std::filesystem::path& path, const std::string& file) {
  silence_dcmtk();
  DcmFileFormat format;
  DRTStructureSetIOD set;
  OFCondition condition = format.loadFile(OFFilename(path.c_str()));
  if (condition.good()) condition = set.read(*format.getDataset());
  if (condition.bad()) throw InputError(file + ": dcmrt refuses this structure set: " + std::string(condition.text()));
  PackedWriter out;
  const std::map<int, std::string> names = names_of(set);
  DRTROIContourSequence& list = set.getROIContourSequence();
  out.put(static_cast<std::uint64_t>(list.getNumberOfItems()));
  for (std::size_t n = 0; n < list.getNumberOfItems(); ++n) pack_structure(out, list.getItem(n), names);
  return out.take();
}

Contour unpacked_contour(PackedReader& in, const std::string& file) {
  Contour contour;
  for (std::uint64_t left = in.get_count(24); left > 0; --left) {
    const double x = in.get<double>(), y = in.get<double>(), z = in.get<double>();
    const Eigen::Vector3d point(x, y, z);
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthestContour)
      throw InputError(file + ": a contour point is no number or lies more than 100 m away");
    contour.push_back(point);
  }
  return contour;
}

Structure unpacked_structure(PackedReader& in, const std::string& file) {
  Structure structure;
  structure.number = in.get<std::int32_t>();
  structure.name = std::string(in.get_text());
  for (std::uint64_t left = in.get_count(8); left > 0; --left) {
    Contour contour = unpacked_contour(in, file);
    if (contour.empty()) ++structure.others;
    if (!contour.empty()) structure.closed.push_back(std::move(contour));
  }
  return structure;
}

/// The one file of a series of structures, which our own parser has passed.
const DicomInstance& structure_file(const CataloguedSeries& series, const std::string& input) {
  if (series.instances.size() != 1)
    throw InputError(input + ": the series holds " + std::to_string(series.instances.size()) + " structure sets (" +
                     series.instances[0].name + ", " + series.instances[1].name + ", ...): give one of them");
  const DicomInstance& file = series.instances.front();
  if (!file.problem.empty()) throw InputError(file.problem);
  std::error_code error;
  if (std::filesystem::file_size(file.path, error) > kMostBytes || error)
    throw InputError(file.name + ": is larger than a structure set may be (512 MiB)");
  return file;
}

}  // namespace

std::vector<Structure> read_structures(const DicomStudy& study, const Progress& progress, std::optional<int> number) {
  const DicomInput& files = study.files();
  const CataloguedSeries& series =
      choose(study.catalogue(), DicomKind::kStructureSet, number, files.name(), "structures");
  const std::filesystem::path path = structure_file(series, files.name()).path;
  const std::string file = series.instances.front().name;
  load_dcmtk_dictionary();
  const std::string bytes =
      in_child(file, ChildLimits{std::uint64_t{1} << 30, 300}, progress, [&] { return load_structures(path, file); });
  PackedReader in(bytes, file);
  std::vector<Structure> structures;
  for (std::uint64_t left = in.get_count(20); left > 0; --left) structures.push_back(unpacked_structure(in, file));
  std::stable_sort(structures.begin(), structures.end(),
                   [](const Structure& a, const Structure& b) { return a.number < b.number; });
  return structures;
}

}  // namespace trocar
