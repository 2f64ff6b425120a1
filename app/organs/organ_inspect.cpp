#include "app/organs/organ_inspect.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/progress_display.h"
#include "app/organs/import_options.h"
#include "app/organs/organ_files.h"
#include "haptics/input_error.h"
#include "tissue/imaging/dicom/dicom_reader.h"
#include "tissue/imaging/dicom/dicom_segmentation.h"
#include "tissue/imaging/dicom/dicom_study.h"
#include "tissue/imaging/dicom/structure_contours.h"
#include "tissue/imaging/labels/label_choice.h"
#include "tissue/imaging/labels/label_table.h"
#include "tissue/imaging/labels/label_table_file.h"
#include "tissue/imaging/volumes/volume_reader.h"
#include "tissue/organ/surface_import.h"

namespace trocar {
namespace {

using Json = nlohmann::ordered_json;

Json grid_json(const std::array<int, 3>& size, const Eigen::Affine3d& frame) {
  Json spacing = Json::array();
  for (int axis = 0; axis < 3; ++axis) spacing.push_back(std::round(frame.linear().col(axis).norm() * 1e6) / 1e6);
  return {{"size", size}, {"spacing_mm", spacing}};
}

std::size_t voxels_of(const LabelVolume& layer, int number) {
  return static_cast<std::size_t>(std::count(layer.labels.begin(), layer.labels.end(), number));
}

Json segments_json(const LabelMap& map, const LabelTable* table) {
  Json json{{"kind", "label map"},
            {"modality", map.modality},
            {"layers", Json::array()},
            {"segments", Json::array()},
            {"notes", map.notes}};
  for (const LabelVolume& layer : map.layers) json["layers"].push_back(grid_json(layer.size, layer.index_to_ras_mm));
  for (const Segment& segment : map.segments) {
    const LabelVolume& layer = map.layers[segment.layer];
    const std::size_t voxels = voxels_of(layer, segment.number);
    std::string name = segment.name;
    if (name.empty() && table) name = std::string(table->name_of(segment.number).value_or(""));
    json["segments"].push_back(
        {{"layer", segment.layer},
         {"number", segment.number},
         {"name", name},
         {"voxels", voxels},
         {"volume_ml", std::round(static_cast<double>(voxels) * layer.voxel_volume_ml() * 1e3) / 1e3}});
  }
  const bool unnamed = std::any_of(map.segments.begin(), map.segments.end(),
                                   [](const Segment& segment) { return segment.name.empty(); });
  json["tables_that_fit"] = unnamed ? guess_label_table(map) : std::vector<std::string>{};
  return json;
}

Json image_json(const ImageVolume& image) {
  Json json = grid_json(image.size, image.index_to_ras_mm);
  const auto [low, high] = std::minmax_element(image.values.begin(), image.values.end());
  json["kind"] = "image";
  json["modality"] = image.modality;
  json["values"] = {*low, *high};
  json["notes"] = image.notes;
  return json;
}

/// A label map, or the image that it turns out to be.
Json volume_json(const OrganInspectOptions& options) {
  std::optional<OwnLabelTable> own;
  if (!options.label_table.empty()) own = label_table_or_file(options.label_table);
  try {
    const LabelMap map = read_label_map(options.input, options.progress);
    if (!own && !map.table.empty()) own = label_table_or_file(map.table);
    return segments_json(map, own ? &own->table() : nullptr);
  } catch (const InputError& no_labels) {
    try {
      return image_json(read_image_volume(options.input, options.progress));
    } catch (const InputError&) {
      throw no_labels;
    }
  }
}

const char* kind_name(DicomKind kind) {
  switch (kind) {
    case DicomKind::kImage:
      return "image";
    case DicomKind::kSegmentation:
      return "segmentation";
    case DicomKind::kStructureSet:
      return "structure set";
    case DicomKind::kOther:
      break;
  }
  return "other";
}

/// Structures by their place in the list, which is their label; nothing is filled for it.
Json structures_json(const DicomStudy& study, int series, const Progress& progress) {
  Json list = Json::array();
  for (const Structure& structure : read_structures(study, progress, series))
    list.push_back({{"number", list.size() + 1}, {"name", structure.name}, {"contours", structure.closed.size()}});
  return list;
}

Json dicom_json(const OrganInspectOptions& options) {
  Json json{{"kind", "DICOM"}, {"series", Json::array()}};
  const DicomStudy study(options.input, options.progress);
  for (const DicomSeries& one : study.series()) {
    json["series"].push_back({{"number", one.number},
                              {"kind", kind_name(one.kind)},
                              {"modality", one.modality},
                              {"images", one.images},
                              {"rows", one.rows},
                              {"columns", one.columns},
                              {"spacing_mm", one.spacing_mm},
                              {"extent_mm", one.extent_mm},
                              {"hash", one.hash},
                              {"problem", one.problem},
                              {"words", describe(one)}});
    if (one.kind == DicomKind::kStructureSet && one.problem.empty())
      json["series"].back()["structures"] = structures_json(study, one.number, options.progress);
    if (one.kind != DicomKind::kSegmentation) continue;
    const LabelMap map = read_dicom_segmentation(study, options.progress, one.number);
    json["series"].back()["segments"] = segments_json(map, nullptr)["segments"];
  }
  return json;
}

/// A folder or a zip of one file an organ.
Json files_json(const OrganFiles& files, const Progress& progress) {
  if (!files.volumes.empty()) return segments_json(combined_masks(files, {}, {}, progress).map, nullptr);
  Json json{{"kind", "surface"}, {"parts", Json::array()}};
  for (const OrganFile& file : files.surfaces) {
    std::size_t triangles = 0;
    for (const SurfacePart& part : list_surface_parts(file.path, progress)) triangles += part.triangles;
    json["parts"].push_back({{"name", file.name}, {"triangles", triangles}});
  }
  return json;
}

Json surface_json(const OrganInspectOptions& options) {
  Json json{{"kind", "surface"}, {"parts", Json::array()}};
  for (const SurfacePart& part : list_surface_parts(options.input, options.progress))
    json["parts"].push_back({{"name", part.name}, {"triangles", part.triangles}});
  return json;
}

std::string segment_lines(const Json& segments) {
  std::ostringstream out;
  for (const Json& segment : segments) {
    out << "  " << segment["number"].get<int>()
        << (segment["name"].get<std::string>().empty() ? "" : " " + segment["name"].get<std::string>());
    if (segment["layer"].get<int>() > 0) out << " (layer " << segment["layer"].get<int>() << ")";
    out << ": " << segment["voxels"].get<std::size_t>() << " voxels, " << segment["volume_ml"].get<double>() << " mL\n";
  }
  return out.str();
}

std::string grid_words(const Json& grid) {
  std::ostringstream out;
  out << grid["size"][0] << " x " << grid["size"][1] << " x " << grid["size"][2] << " voxels of "
      << grid["spacing_mm"][0] << " x " << grid["spacing_mm"][1] << " x " << grid["spacing_mm"][2] << " mm";
  return out.str();
}

std::string words(const Json& json) {
  std::ostringstream out;
  const std::string kind = json["kind"];
  if (kind == "label map") {
    out << "label map, " << grid_words(json["layers"][0])
        << (json["layers"].size() > 1 ? ", " + std::to_string(json["layers"].size()) + " layers" : "") << "\n"
        << segment_lines(json["segments"]);
    std::string tables;
    for (const Json& table : json["tables_that_fit"]) tables += (tables.empty() ? "" : ", ") + table.get<std::string>();
    if (!tables.empty()) out << "tables that could have numbered it: " << tables << "\n";
  } else if (kind == "image") {
    out << "image (" << json["modality"].get<std::string>() << "), " << grid_words(json) << ", values "
        << json["values"][0] << " to " << json["values"][1] << "\n";
  } else if (kind == "surface") {
    out << "surface\n";
    for (const Json& part : json["parts"]) {
      const std::string name = part["name"];
      out << "  " << name << (name.empty() ? "" : ": ") << part["triangles"] << " triangles\n";
    }
  } else {
    for (const Json& series : json["series"]) {
      out << series["words"].get<std::string>()
          << (series["problem"].get<std::string>().empty() ? "" : "\n     " + series["problem"].get<std::string>())
          << "\n";
      if (series.contains("segments")) out << segment_lines(series["segments"]);
      if (series.contains("structures"))
        for (const Json& structure : series["structures"])
          out << "  " << structure["number"] << " " << structure["name"].get<std::string>() << ": "
              << structure["contours"] << " contours\n";
    }
  }
  if (json.contains("notes"))
    for (const Json& note : json["notes"]) out << "note: " << note.get<std::string>() << "\n";
  return out.str();
}

}  // namespace

int organ_inspect(const OrganInspectOptions& options, std::ostream& out, std::ostream&) {
  namespace fs = std::filesystem;
  if (!fs::exists(options.input)) throw InputError(options.input + ": no such file or folder");
  refuse_own_manifest(options.input);
  Json json;
  if (!fs::is_directory(options.input) && is_volume_file(options.input))
    json = volume_json(options);
  else if (!fs::is_directory(options.input) && is_surface_file(options.input))
    json = surface_json(options);
  else if (const auto files = organ_files({options.input}, options.progress))
    json = files_json(*files, options.progress);
  else
    json = dicom_json(options);
  out << (options.json ? json.dump(2) + "\n" : words(json));
  return 0;
}

void add_organ_inspect(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganInspectOptions>();
  OrganInspectOptions& o = *given;
  CLI::App* inspect =
      add_command(parent, "inspect", "What an input holds: DICOM series, labels, parts of a surface", chosen, [given] {
        ProgressDisplay progress(std::cerr, error_is_terminal());
        given->progress = progress.function();
        return organ_inspect(*given, std::cout, std::cerr);
      });
  inspect->add_option("input", o.input, kInputForms)->required();
  inspect->add_option("--label-table", o.label_table, "Table that names the numbers");
  inspect->add_flag("--json", o.json, "As JSON");
}

}  // namespace trocar
