#include <cmath>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/imaging/dicom/dicom_tags.h"

namespace trocar {
namespace {

constexpr double kFarthest = 1e5;                           // mm: a position of 100 m is no position
constexpr double kSmallestStep = 1e-3, kLargestStep = 100;  // mm between pixels
constexpr double kCosineError = 2e-3;

struct Place {
  std::string where;  ///< begins messages

  std::vector<double> numbers(const DicomItem* item, DicomTag tag, std::size_t count, const char* what) const {
    const auto values = item != nullptr ? item->decimals(tag) : std::nullopt;
    if (!values)
      throw InputError(where + ": has no usable " + what + ": without it nobody can tell where the image lies; " +
                       "scanned pictures, screen shots and reports cannot become a volume");
    if (values->size() != count)
      throw InputError(where + ": " + what + " holds " + std::to_string(values->size()) + " numbers instead of " +
                       std::to_string(count));
    return *values;
  }

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(where + ": " + what); }
};

void read_orientation(const Place& at, const DicomItem* item, SlicePlace& place) {
  const auto cosines = at.numbers(item, tag::kOrientation, 6, "ImageOrientationPatient");
  place.along_row = Eigen::Vector3d(cosines[0], cosines[1], cosines[2]);
  place.along_column = Eigen::Vector3d(cosines[3], cosines[4], cosines[5]);
  const bool unit =
      std::abs(place.along_row.norm() - 1) < kCosineError && std::abs(place.along_column.norm() - 1) < kCosineError;
  if (!unit || std::abs(place.along_row.dot(place.along_column)) > kCosineError)
    at.refuse("ImageOrientationPatient is not two unit vectors at right angles");
  place.along_row.normalize();
  place.along_column -= place.along_column.dot(place.along_row) * place.along_row;
  place.along_column.normalize();
}

void read_rescale(const Place& at, const DicomItem* item, SlicePlace& place) {
  for (const auto& [tag, into] : {std::pair(tag::kSlope, &place.slope), std::pair(tag::kIntercept, &place.intercept)}) {
    if (item == nullptr || item->text(tag).empty()) continue;
    const auto value = item->decimals(tag);
    if (!value || value->size() != 1 || std::abs((*value)[0]) > 1e9)
      at.refuse("RescaleSlope or RescaleIntercept is not one number");
    *into = (*value)[0];
  }
  if (place.slope.has_value() != place.intercept.has_value())
    at.refuse("has one of RescaleSlope and RescaleIntercept without the other");
  if (place.slope && std::abs(*place.slope) < 1e-12) at.refuse("RescaleSlope is 0: it would erase the image");
}

SlicePlace place_of(const DicomItem& data, std::size_t frame, const Place& at) {
  const auto group = [&](DicomTag tag) { return frame_group(data, frame, tag); };
  SlicePlace place;
  const auto position = at.numbers(group(tag::kPlanePosition), tag::kPosition, 3, "ImagePositionPatient");
  place.position = Eigen::Vector3d(position[0], position[1], position[2]);
  if (place.position.cwiseAbs().maxCoeff() > kFarthest) at.refuse("ImagePositionPatient lies more than 100 m away");
  read_orientation(at, group(tag::kPlaneOrientation), place);
  const auto spacing = at.numbers(group(tag::kPixelMeasures), tag::kPixelSpacing, 2, "PixelSpacing");
  for (const double step : spacing)
    if (!(step >= kSmallestStep && step <= kLargestStep)) at.refuse("PixelSpacing is not between 0.001 and 100 mm");
  place.column_step = spacing[0],
  place.row_step = spacing[1];  // PS3.3 10.7.1.3: first between rows, then between columns
  const DicomItem* rescale = group(tag::kValueTransformation);
  read_rescale(at, rescale != nullptr ? rescale : &data, place);
  return place;
}

}  // namespace

const DicomItem* frame_group(const DicomItem& data, std::size_t frame, DicomTag group) {
  const DicomItem* shared = data.first_item(tag::kSharedGroups);
  const DicomElement* frames = data.find(tag::kFrameGroups);
  const DicomItem* own = frames != nullptr && frame < frames->items.size() ? &frames->items[frame] : nullptr;
  if (own == nullptr && shared == nullptr) return &data;
  for (const DicomItem* where : {own, shared})
    if (where != nullptr)
      if (const DicomItem* item = where->first_item(group)) return item;
  return nullptr;
}

std::vector<SlicePlace> slice_places(const DicomItem& data, int frames, const std::string& name) {
  const DicomElement* groups = data.find(tag::kFrameGroups);
  if (groups != nullptr && groups->items.size() != static_cast<std::size_t>(frames))
    throw InputError(name + ": says that it has " + std::to_string(frames) + " frames but describes " +
                     std::to_string(groups->items.size()));
  if (groups == nullptr && frames > 1)
    throw InputError(name + ": holds " + std::to_string(frames) +
                     " frames without a position for each (an older multi-frame kind); " +
                     "export the series as single slices or as an enhanced multi-frame image");
  std::vector<SlicePlace> places;
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames); ++frame)
    places.push_back(place_of(data, frame, {frames > 1 ? name + ": frame " + std::to_string(frame + 1) : name}));
  return places;
}

}  // namespace trocar
