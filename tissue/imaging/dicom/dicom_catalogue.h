// The files of an input, sorted into series.
//
// Order of the series: study, series number, series UID, kind; so it does not depend on file names, and a folder and
// its zip number alike. Thread: any.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tissue/imaging/dicom/dicom_input.h"
#include "tissue/imaging/dicom/dicom_instance.h"
#include "tissue/imaging/dicom/slice_stack.h"

namespace trocar {

struct CataloguedSeries {
  DicomSeries facts;
  std::vector<DicomInstance> instances;  ///< by file name
};

struct DicomCatalogue {
  std::vector<CataloguedSeries> series;
  std::vector<std::string> notes;
};

/// @throws InputError when there is no DICOM file in it, or more images than an import may hold
DicomCatalogue catalogue(const DicomInput& input, const Progress& progress);

/// The series of `kind` with that number; without a number the only one of that kind.
/// @param what "images", "a segmentation", "structures" in messages
/// @throws InputError when there is none, or several and no number
const CataloguedSeries& choose(const DicomCatalogue& all, DicomKind kind, std::optional<int> number,
                               const std::string& input, const std::string& what);

/// The slices of a series of images in the order of its instances and their frames.
/// @throws InputError with the first problem of an instance
std::vector<StackSlice> slices_of(const CataloguedSeries& series);

}  // namespace trocar
