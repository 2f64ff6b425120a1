#include "app/organs/organ_files.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "app/organs/chosen_labels.h"
#include "haptics/digest/digest.h"
#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/segment_layers.h"
#include "tissue/imaging/labels/label_grid.h"
#include "tissue/organ/file_lock.h"
#include "tissue/organ/organ_set.h"
#include "tissue/organ/surface_import.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

enum class Kind { kVolume, kSurface, kVoxels, kHidden, kDicom, kOther };

/// By the name; files that no reader takes may still be DICOM.
Kind kind_of_name(const std::string& name) {
  const std::string file = fs::path(name).filename().string();
  if (file.starts_with('.')) return Kind::kHidden;  // among them the shadows that macOS puts into archives
  if (is_surface_file(name)) return Kind::kSurface;
  if (!is_volume_file(name)) return file.ends_with(".dcm") ? Kind::kDicom : Kind::kOther;
  return file.find(".img") != std::string::npos ? Kind::kVoxels : Kind::kVolume;  // of a pair, beside its .hdr
}

bool has_dicom_signature(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string start(132, '\0');
  return in.read(start.data(), 132) && start.ends_with("DICM");
}

void take(OrganFiles& files, Kind kind, const fs::path& path) {
  if (kind == Kind::kVolume) files.volumes.push_back({path, plain_stem(path)});
  if (kind == Kind::kSurface) files.surfaces.push_back({path, path.stem().string()});
  if (kind == Kind::kOther) ++files.passed_over;
}

std::optional<OrganFiles> of_folder(const fs::path& folder) {
  OrganFiles files{folder.string(), {}, {}};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || is_name_lock(entry.path())) continue;
    Kind kind = kind_of_name(entry.path().string());
    if (kind == Kind::kDicom || (kind == Kind::kOther && has_dicom_signature(entry.path()))) return std::nullopt;
    take(files, kind, entry.path());
  }
  return files;
}

/// The files are given back the names that they have in the archive, in a folder of their own.
std::optional<OrganFiles> of_zip(const fs::path& archive, const Progress& progress) {
  const std::vector<std::string> names = names_in_zip(archive, progress);
  const auto any = [&](auto test) { return std::any_of(names.begin(), names.end(), test); };
  const auto wanted = [](const std::string& name) {
    const Kind kind = kind_of_name(name);
    return kind == Kind::kVolume || kind == Kind::kSurface || kind == Kind::kVoxels;
  };
  if (!any(wanted) || any([](const std::string& name) { return kind_of_name(name) == Kind::kDicom; }))
    return std::nullopt;
  OrganFiles files{archive.string(), {}, {}};
  files.zip = std::make_unique<UnpackedZip>(archive, ZipLimits{}, progress, wanted);
  const fs::path folder = files.zip->folder() / "named";
  fs::create_directory(folder);
  for (const UnpackedZip::File& file : files.zip->files()) {
    const fs::path named = folder / file.name;
    if (fs::exists(named)) throw InputError(files.input + ": holds two files called " + file.name);
    fs::rename(file.path, named);
    take(files, kind_of_name(file.name), named);
  }
  return files;
}

OrganFiles of_list(const std::vector<std::string>& inputs) {
  OrganFiles files{std::to_string(inputs.size()) + " files", {}, {}};
  for (const std::string& input : inputs) {
    Kind kind = kind_of_name(input);
    if ((kind == Kind::kDicom || kind == Kind::kOther) && has_dicom_signature(input)) kind = Kind::kVolume;
    if (!fs::is_regular_file(input) || (kind != Kind::kVolume && kind != Kind::kSurface))
      throw InputError(input +
                       ": of several inputs each is a label map, a DICOM segmentation or a surface (images: give "
                       "their folder alone)");
    take(files, kind, input);
  }
  return files;
}

/// An image that lies among masks, or the reason why the file is no mask: values from 0 to 1 are shares of an organ.
ImageVolume image_among(const OrganFile& file, const VolumeReading& reading, const Progress& progress,
                        const InputError& no_mask) {
  std::optional<ImageVolume> image;
  try {
    image = read_image_volume(file.path, progress, reading);
  } catch (const InputError&) {
    throw no_mask;
  }
  const auto [least, most] = std::minmax_element(image->values.begin(), image->values.end());
  if (*least >= 0 && *most <= 1) throw no_mask;
  return std::move(*image);
}

/// "24 x 24 x 24 voxels of 3 x 3 x 3 mm from -35, 12, 100 mm RAS"
std::string described(const VoxelGrid& grid) {
  const Eigen::Vector3d step = grid.index_to_ras_mm.linear().colwise().norm();
  const Eigen::Vector3d from = grid.index_to_ras_mm.translation();
  std::ostringstream text;
  text << std::setprecision(6) << grid.size[0] << " x " << grid.size[1] << " x " << grid.size[2] << " voxels of "
       << step.x() << " x " << step.y() << " x " << step.z() << " mm from " << from.x() << ", " << from.y() << ", "
       << from.z() << " mm RAS";
  return text.str();
}

/// Lays the masks into layers one after the other.
class MaskGatherer {
 public:
  explicit MaskGatherer(const std::string& input) : input_(input), layers_(input) {}

  void add(const OrganFile& file, LabelMap&& map) {
    if (map.segments.empty()) {
      empty_.push_back(file.name);
      return;
    }
    const VoxelGrid grid = grid_of(map.layers.front());
    if (grid_file_.empty()) grid_file_ = file.path.filename().string();
    if (!layers_.hold(grid))
      throw InputError(file.path.string() + ": lies on another grid (" + described(grid) + ") than " + grid_file_ +
                       " (" + described(layers_.grid()) +
                       "): masks of one scene are cut-outs of one image; import it by itself, or export all on one "
                       "grid");
    const bool several = map.segments.size() > 1;
    for (Segment segment : map.segments) {
      if (several && segment.name.empty())
        throw InputError(file.path.string() + ": holds several labels without names, where one mask an organ is " +
                         "wanted: give it by itself with --label-table");
      if (segment.name.empty()) segment.name = file.name;
      const int from = segment.number;
      combined_.origin[++number_] = {
          file.path.filename().string(), digest::of_file(file.path), "unknown", "mm", segment.number, segment.name, ""};
      segment.number = number_;
      const LabelVolume& layer = map.layers[segment.layer];
      layers_.add(std::move(segment), layer, from);
    }
    for (const std::string& note : map.notes)
      if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(note);
  }

  void set_image(const OrganFile& file, ImageVolume&& image) {
    if (combined_.image)
      throw InputError(file.path.string() + ": is an image, and so is another file of " + input_ +
                       ": give the masks and one image (--labels)");
    combined_.image = std::move(image);
    notes_.push_back(file.path.filename().string() + " is the image that the masks were drawn on");
  }

  CombinedMasks take() {
    if (number_ == 0) throw InputError(input_ + ": holds no mask that marks a voxel");
    combined_.map = layers_.take();
    if (!empty_.empty())
      notes_.push_back((empty_.size() == 1
                            ? "a mask marks no voxel and was left out: "
                            : std::to_string(empty_.size()) + " masks mark no voxel and were left out: ") +
                       listed_words(empty_, empty_.size()));
    combined_.map.notes = std::move(notes_);
    for (LabelVolume& layer : combined_.map.layers) layer.notes = combined_.map.notes;
    return std::move(combined_);
  }

 private:
  std::string input_, grid_file_;
  SegmentLayers layers_;
  CombinedMasks combined_;
  std::vector<std::string> notes_, empty_;
  int number_ = 0;
};

/// Called so, in any spelling of case.
std::vector<OrganFile>::const_iterator find_file(const std::vector<OrganFile>& files, const std::string& name) {
  const auto exact = std::find_if(files.begin(), files.end(), [&](const OrganFile& file) { return file.name == name; });
  if (exact != files.end()) return exact;
  return std::find_if(files.begin(), files.end(),
                      [&](const OrganFile& file) { return folded_name(file.name) == folded_name(name); });
}

std::string no_such_file(const OrganFiles& all, const std::vector<OrganFile>& files, const std::string& name) {
  constexpr std::size_t kListed = 20;
  std::vector<std::string> names;
  for (const OrganFile& file : files) names.push_back(file.name);
  return all.input + ": holds no file of \"" + name + "\"" + did_you_mean(name, names) + "; it holds " +
         listed_words(names, kListed);
}

}  // namespace

void refuse_own_manifest(const std::string& input) {
  const bool scene = input.ends_with(kOrganSetSuffix);
  if (!scene && !input.ends_with(kOrganSuffix)) return;
  throw InputError(input + ": is " + (scene ? "a scene" : "an organ") +
                   " of Trocar already: `trocar organ info` says what it is, `trocar organ export` gives its surface");
}

std::string plain_stem(const fs::path& path) {
  const std::string file = path.filename().string();
  for (const std::string_view suffix : {".nii.gz", ".seg.nrrd", ".hdr.gz"})
    if (file.ends_with(suffix)) return file.substr(0, file.size() - suffix.size());
  return path.stem().string();
}

std::vector<std::string> OrganFiles::asked(const std::vector<OrganFile>& files,
                                           const OrganImportOptions& options) const {
  const bool by_number = std::any_of(options.label.begin(), options.label.end(), [&](const std::string& word) {
    return word.find_first_not_of("0123456789:") == std::string::npos && find_file(files, word) == files.end();
  });
  if (by_number && &files == &volumes) return {};
  if (!options.label.empty() || options.all || options.name.empty()) return options.label;
  if (find_file(files, options.name) != files.end()) return {options.name};
  if (files.size() < 3) return {};  // an image and its mask, which --name names
  throw InputError(no_such_file(*this, files, options.name) + "; to call the scene of all of them so: --all --name " +
                   options.name);
}

std::vector<OrganFile> OrganFiles::chosen(const std::vector<OrganFile>& files,
                                          const std::vector<std::string>& wanted) const {
  if (wanted.empty()) return files;
  std::vector<OrganFile> found;
  for (const std::string& word : wanted) {
    const auto file = find_file(files, word);
    if (file == files.end()) throw InputError(no_such_file(*this, files, word));
    found.push_back(*file);
  }
  return found;
}

std::optional<OrganFiles> organ_files(const std::vector<std::string>& inputs, const Progress& progress) {
  std::optional<OrganFiles> files;
  std::error_code error;
  if (inputs.size() > 1)
    files = of_list(inputs);
  else if (fs::is_directory(inputs.front(), error))
    files = of_folder(inputs.front());
  else if (kind_of_name(inputs.front()) != Kind::kVolume && kind_of_name(inputs.front()) != Kind::kSurface &&
           fs::is_regular_file(inputs.front(), error) && is_zip(inputs.front()))
    files = of_zip(inputs.front(), progress);
  if (!files || (files->volumes.empty() && files->surfaces.empty())) return std::nullopt;
  if (!files->volumes.empty() && !files->surfaces.empty())
    throw InputError(files->input + ": holds volumes (" + files->volumes.front().path.filename().string() +
                     ", ...) and surfaces (" + files->surfaces.front().path.filename().string() +
                     ", ...): give files of one kind");
  const auto by_name = [](const OrganFile& a, const OrganFile& b) {
    return a.name != b.name ? a.name < b.name : a.path < b.path;
  };
  std::sort(files->volumes.begin(), files->volumes.end(), by_name);
  std::sort(files->surfaces.begin(), files->surfaces.end(), by_name);
  return files;
}

CombinedMasks combined_masks(const OrganFiles& files, const std::vector<std::string>& wanted,
                             const VolumeReading& reading, const Progress& progress) {
  MaskGatherer gatherer(files.input);
  VolumeReading how = reading;
  how.may_be_empty = true;
  const std::vector<OrganFile> chosen = files.chosen(files.volumes, wanted);
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    report(progress, "reading masks", static_cast<double>(n) / static_cast<double>(chosen.size()));
    std::optional<LabelMap> mask;
    try {
      mask = is_volume_file(chosen[n].path) ? read_label_map(chosen[n].path, {}, how)
                                            : read_dicom_segmentation(chosen[n].path);
    } catch (const InputError& no_mask) {
      gatherer.set_image(chosen[n], image_among(chosen[n], reading, {}, no_mask));
    }
    if (mask) gatherer.add(chosen[n], std::move(*mask));
  }
  return gatherer.take();
}

}  // namespace trocar
