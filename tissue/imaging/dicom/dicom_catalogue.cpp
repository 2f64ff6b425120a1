#include "tissue/imaging/dicom/dicom_catalogue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_tags.h"

namespace trocar {
namespace {

constexpr std::size_t kMostFrames = 200000;

using Key = std::tuple<std::string, long, std::string, DicomKind>;

std::string short_hash(const std::string& identity) { return digest::of_bytes(identity).substr(0, 8); }

const char* plural(int count) { return count == 1 ? " image" : " images"; }

/// Frames as files claim them, which may be any number.
int sum_of(int a, int b) { return static_cast<int>(std::min(std::int64_t{a} + b, std::int64_t{1000000000})); }

/// What can be said of a series of images without decoding any.
void measure(CataloguedSeries& series, const std::string& input) {
  DicomSeries& facts = series.facts;
  for (const DicomInstance& instance : series.instances) {
    facts.images = sum_of(facts.images, instance.frames);
    if (facts.rows == 0) facts.rows = instance.rows, facts.columns = instance.columns;
  }
  try {
    const std::vector<StackSlice> slices = slices_of(series);
    const SlicePlace& first = slices.front().place;
    facts.spacing_mm = {first.row_step, first.column_step, 0};
    facts.extent_mm = {first.row_step * facts.columns, first.column_step * facts.rows, 0};
    const SliceStack stack = stacked(slices, input);
    facts.spacing_mm[2] = stack.slice_step;
    facts.extent_mm[2] = stack.slice_step * static_cast<double>(slices.size());
  } catch (const InputError& error) {
    facts.problem = error.what();
  }
}

void describe_series(CataloguedSeries& series, const std::string& input) {
  const DicomInstance& first = series.instances.front();
  series.facts.kind = first.kind;
  series.facts.modality = first.modality;
  series.facts.hash =
      short_hash(first.study + "|" + first.series + "|" + std::to_string(first.series_number) + series.facts.part);
  if (first.kind == DicomKind::kImage) return measure(series, input);
  for (const DicomInstance& instance : series.instances) {
    if (series.facts.problem.empty()) series.facts.problem = instance.problem;
    if (first.kind != DicomKind::kSegmentation) continue;
    series.facts.images = sum_of(series.facts.images, instance.frames);
    series.facts.rows = instance.rows, series.facts.columns = instance.columns;
  }
}

/// A damaged file that tells its series but not what it is belongs to the images of that series.
void join_damaged(std::map<Key, std::vector<DicomInstance>>& groups) {
  for (auto group = groups.begin(); group != groups.end();) {
    const auto& [study, number, series, kind] = group->first;
    const auto images = groups.find({study, number, series, DicomKind::kImage});
    const bool damaged = kind == DicomKind::kOther && !group->second.front().problem.empty();
    if (!damaged || images == groups.end()) {
      ++group;
      continue;
    }
    for (DicomInstance& instance : group->second) images->second.push_back(std::move(instance));
    group = groups.erase(group);
  }
}

/// Whether no two of the images lie in one place.
bool apart(const std::vector<DicomInstance>& images) {
  std::set<std::array<long, 3>> places;
  for (const DicomInstance& instance : images) {
    const Eigen::Vector3d at = instance.image->places.front().position * 100;  // hundredths of a millimetre
    if (!places.insert({std::lround(at.x()), std::lround(at.y()), std::lround(at.z())}).second) return false;
  }
  return true;
}

struct Pass {
  std::string part;
  std::vector<DicomInstance> instances;
};

/// Values as numbers where they are numbers: 2 comes before 10.
std::pair<double, std::string> sorted_by(const std::string& value) {
  return {std::strtod(value.c_str(), nullptr), value};
}

/// A series with several images in one place (echoes, phases, directions), taken apart by the first element that tells
/// them apart in whole piles of one height; else as it is.
std::vector<Pass> passes(std::vector<DicomInstance>&& instances) {
  const auto plain = [](const DicomInstance& one) { return one.image && one.image->places.size() == 1; };
  if (std::all_of(instances.begin(), instances.end(), plain) && !apart(instances))
    for (std::size_t what = 0; what < kPassNames.size(); ++what) {
      std::map<std::pair<double, std::string>, std::vector<DicomInstance>> piles;
      for (const DicomInstance& one : instances) piles[sorted_by(one.pass[what])].push_back(one);
      const std::size_t height = piles.begin()->second.size();
      const bool fits =
          piles.size() > 1 && height > 1 && std::all_of(piles.begin(), piles.end(), [&](const auto& pile) {
            return pile.second.size() == height && apart(pile.second);
          });
      if (!fits) continue;
      std::vector<Pass> all;
      for (auto& [value, pile] : piles)
        all.push_back({std::string(kPassNames[what]) + " " + std::to_string(all.size() + 1) + " of " +
                           std::to_string(piles.size()),
                       std::move(pile)});
      return all;
    }
  std::vector<Pass> one;
  one.push_back({"", std::move(instances)});
  return one;
}

bool is_directory_file(const DicomFile& file) { return file.data.find(tag::kDirectoryRecords) != nullptr; }

std::map<Key, std::vector<DicomInstance>> grouped(const DicomInput& input, const Progress& progress) {
  std::map<Key, std::vector<DicomInstance>> groups;
  InflateBudget budget;
  std::size_t done = 0, frames = 0;
  for (const DicomInput::File& file : input.files()) {
    report(progress, "looking at the files", static_cast<double>(done++) / static_cast<double>(input.files().size()));
    std::unique_ptr<ByteSource> source;
    const auto elements = read_dicom_elements(file.path, file.name, budget, &source);
    if (!elements || (is_directory_file(*elements) && !input.single())) continue;
    DicomInstance instance = instance_of(*elements, file.path, file.name, source->size());
    if (instance.image) frames += instance.image->places.size();
    if (frames > kMostFrames)
      throw InputError(input.name() + ": holds more than " + std::to_string(kMostFrames) + " images");
    const Key key{instance.study, instance.series_number, instance.series, instance.kind};
    groups[key].push_back(std::move(instance));
  }
  join_damaged(groups);
  return groups;
}

}  // namespace

DicomCatalogue catalogue(const DicomInput& input, const Progress& progress) {
  DicomCatalogue all;
  all.notes = input.notes();
  for (auto& [key, instances] : grouped(input, progress)) {
    if (instances.front().series == kNoSeries)
      all.notes.push_back(std::to_string(instances.size()) + (instances.size() == 1 ? " image names" : " images name") +
                          " no series (their SeriesInstanceUID is empty): taken as one series");
    for (Pass& pass : passes(std::move(instances))) {
      CataloguedSeries& series = all.series.emplace_back();
      series.instances = std::move(pass.instances);
      series.facts.number = static_cast<int>(all.series.size());
      series.facts.part = pass.part;
      describe_series(series, input.name());
    }
  }
  if (!all.series.empty()) return all;
  if (input.single())
    throw InputError(input.name() + ": is not a DICOM file: it has no DICOM signature and does not start as one");
  throw InputError(input.name() + ": holds no DICOM files (" + std::to_string(input.files().size()) +
                   " files were looked at)");
}

const CataloguedSeries& choose(const DicomCatalogue& all, DicomKind kind, std::optional<int> number,
                               const std::string& input, const std::string& what) {
  const CataloguedSeries* chosen = nullptr;
  std::string list;
  int fitting = 0;
  for (const CataloguedSeries& series : all.series) {
    list += "\n  " + describe(series.facts);
    const bool fits = number ? series.facts.number == *number : series.facts.kind == kind;
    if (fits) ++fitting, chosen = &series;
  }
  if (number && chosen == nullptr)
    throw InputError(input + ": has no series " + std::to_string(*number) + "; it holds" + list);
  const DicomSeries& first = all.series.front().facts;
  if (fitting == 0 && all.series.size() == 1 && first.kind == DicomKind::kOther && !first.problem.empty())
    throw InputError(first.problem);
  if (fitting == 0) throw InputError(input + ": holds no series of " + what + "; it holds" + list);
  if (fitting > 1)
    throw InputError(input + ": holds " + std::to_string(fitting) + " series of " + what +
                     "; choose one with --series N" +
                     (kind == DicomKind::kSegmentation ? ", or all with --all:" : ":") + list);
  if (chosen->facts.kind != kind)
    throw InputError(input + ": series " + std::to_string(*number) + " is not one of " + what + "; it holds" + list);
  return *chosen;
}

std::vector<StackSlice> slices_of(const CataloguedSeries& series) {
  std::vector<StackSlice> slices;
  for (const DicomInstance& instance : series.instances) {
    if (!instance.problem.empty()) throw InputError(instance.problem);
    if (!instance.image) throw InputError(instance.name + ": holds no image");
    const DicomImage& image = *instance.image;
    if (instance.frame_of_reference != series.instances.front().frame_of_reference)
      throw InputError(series.instances.front().name + " and " + instance.name +
                       " have different frames of reference: the patient moved between them, they are not one volume");
    for (std::size_t frame = 0; frame < image.places.size(); ++frame)
      slices.push_back(
          {image.places[frame], image.rows, image.columns,
           image.places.size() > 1 ? instance.name + " frame " + std::to_string(frame + 1) : instance.name});
  }
  return slices;
}

std::string describe(const DicomSeries& series) {
  std::string text = std::to_string(series.number) + ": " + series.modality;
  char part[160];
  if (!series.part.empty()) text += ", " + series.part;
  if (series.kind == DicomKind::kStructureSet) text += ", contours of structures";
  if (series.kind == DicomKind::kOther) text += ", no image";
  if (series.images > 0) {
    const char* frames = series.images == 1 ? " frame" : " frames";
    text += ", " + std::to_string(series.images) +
            (series.kind == DicomKind::kSegmentation ? frames : plural(series.images)) + " of " +
            std::to_string(series.columns) + " x " + std::to_string(series.rows);
  }
  if (series.spacing_mm[0] > 0) {
    const auto& s = series.spacing_mm;
    const auto& e = series.extent_mm;
    std::snprintf(part, sizeof part, s[2] > 0 ? ", %.3f x %.3f x %.3f mm, %.0f x %.0f x %.1f mm" : ", %.3f x %.3f mm",
                  s[0], s[1], s[2], e[0], e[1], e[2]);
    text += part;
  }
  if (!series.problem.empty()) text += series.kind == DicomKind::kOther ? ", damaged" : ", not a volume";
  return text + " [" + series.hash + "]";
}

}  // namespace trocar
