#include "tissue/imaging/dicom/dicom_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_catalogue.h"
#include "tissue/imaging/dicom/dicom_pixels.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/slice_volume.h"

namespace trocar {
namespace {

constexpr float kAir = -1024;

/// The wish for every slice of the pile, in its order.
std::vector<DicomPixels::Wish> wishes_of(const CataloguedSeries& series, const SliceStack& stack) {
  std::vector<DicomPixels::Wish> all, sorted;
  for (const DicomInstance& instance : series.instances)
    for (std::size_t frame = 0; frame < instance.image->places.size(); ++frame) all.push_back({&instance, frame});
  for (const std::size_t n : stack.order) sorted.push_back(all[n]);
  return sorted;
}

void require_rescale_alike(const std::vector<StackSlice>& slices) {
  const bool first = slices.front().place.slope.has_value();
  for (const StackSlice& slice : slices)
    if (slice.place.slope.has_value() != first)
      throw InputError(
          slices.front().name + " and " + slice.name +
          ": only one of them has RescaleSlope and RescaleIntercept: " + "their values cannot be compared");
}

std::vector<float> rescaled(const std::vector<float>& values, const SlicePlace& place) {
  if (!place.slope) return values;
  std::vector<float> result(values.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    result[n] = static_cast<float>(*place.slope * static_cast<double>(values[n]) + *place.intercept);
  return result;
}

bool same_rescale(const std::vector<StackSlice>& slices) {
  const SlicePlace& first = slices.front().place;
  return std::all_of(slices.begin(), slices.end(), [&](const StackSlice& slice) {
    return slice.place.slope == first.slope && slice.place.intercept == first.intercept;
  });
}

bool any(const CataloguedSeries& series, bool DicomImage::*fact) {
  return std::any_of(series.instances.begin(), series.instances.end(),
                     [&](const DicomInstance& one) { return (*one.image).*fact; });
}

/// Farthest that a slice lies from an even step, mm.
double unevenness(const std::vector<StackSlice>& slices, const SliceStack& stack) {
  double worst = 0;
  for (std::size_t n = 0; n < stack.order.size(); ++n) {
    const double height = stack.normal.dot(slices[stack.order[n]].place.position - stack.origin);
    worst = std::max(worst, std::abs(height - static_cast<double>(n) * stack.slice_step));
  }
  return worst;
}

std::vector<std::string> geometry_notes(const std::vector<StackSlice>& slices, const SliceStack& stack) {
  std::vector<std::string> notes;
  char text[256];
  if (!stack.shift.isZero(0)) {
    std::snprintf(
        text, sizeof text,
        "The gantry was tilted by %.2f degrees: every slice was moved within its plane (%.3f mm a slice, linear "
        "interpolation) so that the grid has right angles; what no slice covers holds the value of air.",
        stack.tilt_deg, stack.shift.norm());
    notes.emplace_back(text);
  }
  const double uneven = unevenness(slices, stack);
  if (uneven > 0.01 * stack.slice_step) {
    std::snprintf(text, sizeof text,
                  "The slices lie up to %.3f mm off an even step of %.3f mm; the even step was taken.", uneven,
                  stack.slice_step);
    notes.emplace_back(text);
  }
  return notes;
}

std::vector<std::string> value_notes(const CataloguedSeries& series, const std::vector<StackSlice>& slices,
                                     const std::string& modality) {
  std::vector<std::string> notes;
  const bool rescale = slices.front().place.slope.has_value();
  if (!rescale && modality == "CT")
    notes.emplace_back("The CT has no rescale slope and intercept: stored values were taken for Hounsfield units.");
  if (rescale && !same_rescale(slices))
    notes.emplace_back("Rescale slope and intercept differ between slices; each slice got its own.");
  if (any(series, &DicomImage::inverted))
    notes.emplace_back("The images are meant to be shown inverted (MONOCHROME1); their values were taken as they are.");
  if (any(series, &DicomImage::lossy))
    notes.emplace_back("The images were compressed with loss before they came here: fine detail may be missing.");
  if (any(series, &DicomImage::padded))
    notes.emplace_back("Files hold more bytes of pixels than their images need; the rest was left out.");
  if (modality == "unknown")
    notes.emplace_back("The images are neither CT nor MR; nothing is assumed about their values.");
  return notes;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::size_t damaged_elsewhere(const DicomCatalogue& all) {
  std::size_t count = 0;
  for (const CataloguedSeries& series : all.series)
    for (const DicomInstance& instance : series.instances)
      count += instance.kind == DicomKind::kOther && !instance.problem.empty() ? 1 : 0;
  return count;
}

}  // namespace

ImageVolume read_dicom_series(const std::filesystem::path& input, std::optional<int> number, const Progress& progress) {
  return read_dicom_series(DicomStudy(input, progress), number, progress);
}

ImageVolume read_dicom_series(const DicomStudy& study, std::optional<int> number, const Progress& progress) {
  const DicomInput& files = study.files();
  const DicomCatalogue& all = study.catalogue();
  const CataloguedSeries& series = choose(all, DicomKind::kImage, number, files.name(), "images");
  const std::vector<StackSlice> slices = slices_of(series);
  const SliceStack stack = stacked(slices, files.name());
  require_rescale_alike(slices);
  const std::string modality =
      series.facts.modality == "CT" || series.facts.modality == "MR" ? series.facts.modality : "unknown";
  SliceVolume volume(stack, modality == "CT" ? kAir : 0, files.name());
  DicomPixels::read(wishes_of(series, stack), progress, [&](std::size_t place, const std::vector<float>& values) {
    volume.put(place, rescaled(values, slices[stack.order[place]].place));
  });
  ImageVolume result = volume.take();
  result.modality = modality;
  append(result.notes, all.notes);
  append(result.notes, geometry_notes(slices, stack));
  append(result.notes, value_notes(series, slices, modality));
  if (const std::size_t damaged = damaged_elsewhere(all); damaged > 0)
    result.notes.push_back(std::to_string(damaged) +
                           " damaged DICOM files were passed over; they name no series of images.");
  return result;
}

}  // namespace trocar
