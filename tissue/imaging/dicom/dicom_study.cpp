#include "tissue/imaging/dicom/dicom_study.h"

#include "tissue/imaging/dicom/dicom_catalogue.h"

namespace trocar {

DicomStudy::DicomStudy(const std::filesystem::path& input, const Progress& progress)
    : path_(input),
      files_(std::make_unique<DicomInput>(input, progress)),
      catalogue_(std::make_unique<DicomCatalogue>(trocar::catalogue(*files_, progress))) {}

DicomStudy::~DicomStudy() = default;

std::vector<DicomSeries> DicomStudy::series() const {
  std::vector<DicomSeries> list;
  for (const CataloguedSeries& one : catalogue_->series) list.push_back(one.facts);
  return list;
}

std::vector<DicomSeries> list_dicom(const std::filesystem::path& input, const Progress& progress) {
  return DicomStudy(input, progress).series();
}

}  // namespace trocar
