#include "tissue/imaging/dicom/structure_contours.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmrt/drtstrct.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "haptics/input_error.h"
#include "tissue/imaging/child_process.h"
#include "tissue/imaging/dicom/dcmtk_silence.h"
#include "tissue/imaging/dicom/dicom_catalogue.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/packed_bytes.h"
#include "tissue/imaging/dicom/packed_segment.h"

namespace trocar {
namespace {

constexpr double kFarthestContour = 1e5;  // mm
constexpr std::uint64_t kMostBytes = std::uint64_t{512} << 20;

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

std::optional<SegmentColour> display_colour(const DRTROIContourSequence::Item& item) {
  SegmentColour colour{};
  for (std::size_t part = 0; part < 3; ++part) {
    Sint32 value = -1;
    if (item.getROIDisplayColor(value, part).bad() || value < 0 || value > 255) return std::nullopt;
    colour[part] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

void pack_structure(PackedWriter& out, DRTROIContourSequence::Item& item, const std::map<int, Segment>& told) {
  Sint32 number = 0;
  item.getReferencedROINumber(number);
  const auto found = told.find(number);
  DRTContourSequence& contours = item.getContourSequence();
  Segment segment = found != told.end() ? found->second : Segment{};
  segment.number = number;
  segment.colour = display_colour(item);
  put_segment(out, segment);
  out.put(static_cast<std::uint64_t>(contours.getNumberOfItems()));
  for (std::size_t n = 0; n < contours.getNumberOfItems(); ++n) pack_contour(out, contours.getItem(n));
}

/// Names and codes by the numbers of the structures.
std::map<int, Segment> told_of_structures(DRTStructureSetIOD& set) {
  std::map<int, Segment> told;
  DRTStructureSetROISequence& list = set.getStructureSetROISequence();
  for (std::size_t n = 0; n < list.getNumberOfItems(); ++n) {
    Sint32 number = 0;
    OFString name;
    list.getItem(n).getROINumber(number);
    list.getItem(n).getROIName(name);
    told.try_emplace(number, Segment{0, number, readable_name(name.c_str())});
  }
  DRTRTROIObservationsSequence& observations = set.getRTROIObservationsSequence();
  for (std::size_t n = 0; n < observations.getNumberOfItems(); ++n) {
    Sint32 number = 0;
    observations.getItem(n).getReferencedROINumber(number);
    DRTRTROIIdentificationCodeSequence& codes = observations.getItem(n).getRTROIIdentificationCodeSequence();
    for (std::size_t c = 0; c < codes.getNumberOfItems(); ++c) {
      OFString scheme, value, meaning;
      codes.getItem(c).getCodingSchemeDesignator(scheme);
      codes.getItem(c).getCodeValue(value);
      codes.getItem(c).getCodeMeaning(meaning);
      if (!value.empty())
        told[number].codes.push_back(
            {"type", readable_name(scheme.c_str()), readable_name(value.c_str()), readable_name(meaning.c_str())});
    }
  }
  return told;
}

std::string load_structures(const std::filesystem::path& path, const std::string& file) {
  silence_dcmtk();
  DcmFileFormat format;
  DRTStructureSetIOD set;
  OFCondition condition = format.loadFile(OFFilename(path.c_str()));
  if (condition.good()) condition = set.read(*format.getDataset());
  if (condition.bad()) throw InputError(file + ": dcmrt refuses this structure set: " + std::string(condition.text()));
  PackedWriter out;
  const std::map<int, Segment> told = told_of_structures(set);
  DRTROIContourSequence& list = set.getROIContourSequence();
  out.put(static_cast<std::uint64_t>(list.getNumberOfItems()));
  for (std::size_t n = 0; n < list.getNumberOfItems(); ++n) pack_structure(out, list.getItem(n), told);
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
  Segment told = get_segment(in);
  structure.number = told.number, structure.name = std::move(told.name);
  structure.colour = told.colour, structure.codes = std::move(told.codes);
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
