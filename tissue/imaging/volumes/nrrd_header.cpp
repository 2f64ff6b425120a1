#include "tissue/imaging/volumes/nrrd_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;
using Vectors = std::vector<std::optional<Eigen::Vector3d>>;

VoxelType nrrd_voxel_type(const NrrdFields& header) {
  using enum VoxelType;
  static constexpr std::array<std::pair<std::string_view, VoxelType>, 38> kTypes{{{"signed char", kInt8},
                                                                                  {"int8", kInt8},
                                                                                  {"int8_t", kInt8},
                                                                                  {"uchar", kUint8},
                                                                                  {"unsigned char", kUint8},
                                                                                  {"uint8", kUint8},
                                                                                  {"uint8_t", kUint8},
                                                                                  {"short", kInt16},
                                                                                  {"short int", kInt16},
                                                                                  {"signed short", kInt16},
                                                                                  {"signed short int", kInt16},
                                                                                  {"int16", kInt16},
                                                                                  {"int16_t", kInt16},
                                                                                  {"ushort", kUint16},
                                                                                  {"unsigned short", kUint16},
                                                                                  {"unsigned short int", kUint16},
                                                                                  {"uint16", kUint16},
                                                                                  {"uint16_t", kUint16},
                                                                                  {"int", kInt32},
                                                                                  {"signed int", kInt32},
                                                                                  {"int32", kInt32},
                                                                                  {"int32_t", kInt32},
                                                                                  {"uint", kUint32},
                                                                                  {"unsigned int", kUint32},
                                                                                  {"uint32", kUint32},
                                                                                  {"uint32_t", kUint32},
                                                                                  {"longlong", kInt64},
                                                                                  {"long long", kInt64},
                                                                                  {"long long int", kInt64},
                                                                                  {"int64", kInt64},
                                                                                  {"int64_t", kInt64},
                                                                                  {"ulonglong", kUint64},
                                                                                  {"unsigned long long", kUint64},
                                                                                  {"unsigned long long int", kUint64},
                                                                                  {"uint64", kUint64},
                                                                                  {"uint64_t", kUint64},
                                                                                  {"float", kFloat32},
                                                                                  {"double", kFloat64}}};
  const std::string name = lower_case(header.wanted("type").text);
  for (const auto& [known, type] : kTypes)
    if (name == known) return type;
  header.refuse("type", "no number type that is read here");
}

VoxelEncoding voxel_encoding(const NrrdFields& header) {
  const std::string name = lower_case(header.wanted("encoding").text);
  if (name == "raw") return VoxelEncoding::kRaw;
  if (name == "gzip" || name == "gz") return VoxelEncoding::kDeflated;
  if (name == "ascii" || name == "text" || name == "txt") return VoxelEncoding::kText;
  if (name == "bzip2" || name == "bz2") header.refuse("encoding", "bzip2 is not read here; save it as gzip or raw");
  if (name == "hex") header.refuse("encoding", "hex is not read here; save it as gzip or raw");
  header.refuse("encoding", "unknown; raw, gzip and ascii are read");
}

bool is_swapped(const NrrdFields& header, const VoxelBlock& block) {
  if (header.has("endian")) {
    const std::string name = lower_case(header.wanted("endian").text);
    if (name != "little" && name != "big") header.refuse("endian", "neither little nor big");
    return name == "big";
  }
  if (block.encoding != VoxelEncoding::kText && bytes_of(block.type) > 1)
    header.refuse("endian", "missing, though a voxel has several bytes");
  return false;
}

/// Passes over whole lines of the data file, as `line skip` asks.
std::uint64_t behind_lines(const fs::path& file, std::uint64_t offset, std::int64_t lines) {
  if (lines == 0) return offset;
  const auto bytes = open_plain(file, offset);
  std::vector<unsigned char> block(1 << 16);
  while (const std::size_t got = bytes->read(block.data(), block.size())) {
    for (std::size_t n = 0; n < got; ++n)
      if (block[n] == '\n' && --lines == 0) return offset + n + 1;
    offset += got;
  }
  throw InputError(file.string() + ": lineskip: the file has fewer lines");
}

VoxelBlock voxel_block(const NrrdFields& header, const fs::path& path) {
  VoxelBlock block;
  block.type = nrrd_voxel_type(header);
  block.encoding = voxel_encoding(header);
  block.swapped = is_swapped(header, block);
  const bool detached = header.has("datafile");
  if (!detached && !header.ended)
    throw InputError(header.file + ": header: no empty line ends it, and no field names a data file");
  block.file = detached ? detached_file(path, header.wanted("datafile").text, "datafile") : path;
  block.offset = detached ? 0 : header.data_offset;
  if (header.has("lineskip"))
    block.offset = behind_lines(block.file, block.offset, whole_number(header, "lineskip", 0, 1 << 20));
  if (!header.has("byteskip")) return block;
  const std::int64_t skip = whole_number(header, "byteskip", -1, std::int64_t{1} << 40);
  if (skip < 0 && block.encoding != VoxelEncoding::kRaw) header.refuse("byteskip", "-1 goes with raw data only");
  if (skip >= 0 && block.encoding == VoxelEncoding::kDeflated)
    block.skipped = static_cast<std::uint64_t>(skip);
  else if (skip >= 0)
    block.offset += static_cast<std::uint64_t>(skip);
  block.last_in_file = skip < 0;
  return block;
}

/// What the axes are: three in space, at most one that is not.
struct Axes {
  std::vector<long long> sizes;
  int component_axis = 3;
  std::vector<std::size_t> spatial;
};

bool is_list(const std::string& kind) {
  const std::string name = lower_case(kind);
  return name != "domain" && name != "space" && name != "time" && name != "???" && name != "none";
}

/// Axes without a direction, without a spacing, or of a kind that is no place.
std::vector<bool> not_in_space(const NrrdFields& header, std::size_t dimension) {
  std::vector<bool> outside(dimension, false);
  const auto check = [&](std::size_t count, const char* field) {
    if (count != dimension)
      header.refuse(field, std::to_string(count) + " entries for " + std::to_string(dimension) + " axes");
  };
  if (header.has("spacedirections")) {
    const Vectors directions = nrrd_vectors(header, "spacedirections");
    check(directions.size(), "spacedirections");
    for (std::size_t n = 0; n < dimension; ++n) outside[n] = !directions[n];
  } else if (header.has("spacings")) {
    const auto spacings = nrrd_numbers(header, "spacings");
    check(spacings.size(), "spacings");
    for (std::size_t n = 0; n < dimension; ++n) outside[n] = !spacings[n];
  }
  if (!header.has("kinds")) return outside;
  const auto kinds = nrrd_words(header, "kinds");
  check(kinds.size(), "kinds");
  for (std::size_t n = 0; n < dimension; ++n) {
    if (lower_case(kinds[n]) == "time") header.refuse("kinds", "a series over time; one volume is wanted");
    outside[n] = outside[n] || is_list(kinds[n]);
  }
  return outside;
}

Axes read_axes(const NrrdFields& header) {
  Axes axes;
  const auto dimension = static_cast<std::size_t>(whole_number(header, "dimension", 1, 16));
  if (dimension < 3 || dimension > 4)
    header.refuse("dimension", std::to_string(dimension) + " axes; a volume has 3, a segmentation in layers 4");
  for (const auto& size : nrrd_numbers(header, "sizes")) {
    if (!size || *size != std::floor(*size) || *size < 1 || *size > 1 << 20)
      header.refuse("sizes", "no whole numbers from 1 to 1048576");
    axes.sizes.push_back(static_cast<long long>(*size));
  }
  if (axes.sizes.size() != dimension)
    header.refuse("sizes", std::to_string(axes.sizes.size()) + " entries for " + std::to_string(dimension) + " axes");
  const std::vector<bool> outside = not_in_space(header, dimension);
  for (std::size_t n = 0; n < dimension; ++n) {
    if (!outside[n])
      axes.spatial.push_back(n);
    else
      axes.component_axis = static_cast<int>(n);
  }
  if (axes.spatial.size() != 3)
    header.refuse("dimension", std::to_string(axes.spatial.size()) +
                                   " axes that lie in space; 3 are wanted (a series or a projection is no volume)");
  return axes;
}

/// Directions of the three spatial axes in the file's own space and unit.
Eigen::Matrix3d nrrd_directions(const NrrdFields& header, const Axes& axes) {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Zero();
  if (header.has("spacedirections")) {
    const Vectors directions = nrrd_vectors(header, "spacedirections");
    for (int n = 0; n < 3; ++n) {
      const auto& direction = directions[axes.spatial[static_cast<std::size_t>(n)]];
      if (!direction) header.refuse("spacedirections", "none for an axis that lies in space");
      linear.col(n) = *direction;
    }
    return linear;
  }
  if (!header.has("spacings")) header.refuse("spacedirections", "missing, and so are spacings: how large is a voxel?");
  const auto spacings = nrrd_numbers(header, "spacings");
  for (int n = 0; n < 3; ++n) {
    const auto& spacing = spacings[axes.spatial[static_cast<std::size_t>(n)]];
    if (!spacing) header.refuse("spacings", "none for an axis that lies in space");
    if (*spacing < 0) header.refuse("spacings", "negative: write the direction of an axis into space directions");
    linear(n, n) = *spacing;
  }
  return linear;
}

bool cell_centred(const NrrdFields& header, std::size_t axis) {
  if (!header.has("centers")) return false;
  const auto centers = nrrd_words(header, "centers");
  return axis < centers.size() && lower_case(centers[axis]) == "cell";
}

Eigen::Vector3d origin_of(const NrrdFields& header, const Axes& axes, const Eigen::Matrix3d& linear,
                          std::vector<std::string>& notes) {
  if (header.has("spaceorigin")) {
    const Vectors origin = nrrd_vectors(header, "spaceorigin");
    if (origin.size() != 1 || !origin[0]) header.refuse("spaceorigin", "one vector (x,y,z) is wanted");
    return *origin[0];
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (!header.has("axismins")) {
    notes.push_back("the header gives no origin; (0, 0, 0) assumed");
    return origin;
  }
  const auto mins = nrrd_numbers(header, "axismins");
  for (int n = 0; n < 3; ++n) {
    const std::size_t axis = axes.spatial[static_cast<std::size_t>(n)];
    if (axis >= mins.size() || !mins[axis]) header.refuse("axismins", "no number for an axis that lies in space");
    origin[n] = *mins[axis] + (cell_centred(header, axis) ? 0.5 * linear(n, n) : 0);  // of a cell: its edge
  }
  return origin;
}

/// Signs that turn the file's space into RAS.
Eigen::Vector3d space_signs(const NrrdFields& header, const VolumeReading& reading, std::vector<std::string>& notes) {
  if (header.has("space")) {
    std::string space = header.wanted("space").text;
    if (space.size() > 2 && space.front() == '"' && space.back() == '"') space = space.substr(1, space.size() - 2);
    return ras_signs(space, "space", header.file);
  }
  if (!reading.space.empty()) {
    notes.push_back("the header names no space; " + reading.space + " was asked for");
    return ras_signs(reading.space, "the space asked for", header.file);
  }
  header.refuse("space",
                "missing: the file does not say where left and right are; say so with --frame LPS (or RAS, LAS)");
}

double nrrd_unit_mm(const NrrdFields& header, const VolumeReading& reading, std::vector<std::string>& notes) {
  if (!reading.unit.empty()) {
    notes.push_back("lengths read in " + reading.unit + ", as was asked for");
    return millimetres_in(reading.unit, "--unit", header.file);
  }
  for (const char* field : {"spaceunits", "units"}) {
    if (!header.has(field)) continue;
    std::optional<double> scale;
    for (const std::string& unit : nrrd_words(header, field)) {
      if (unit.empty() || unit == "none" || unit == "???") continue;
      const double own = millimetres_in(unit, field, header.file);
      if (own != scale.value_or(own)) header.refuse(field, "different units along different axes");
      scale = own;
    }
    if (scale) return *scale;
  }
  return 1;
}

void read_nrrd_frame(const NrrdFields& header, const Axes& axes, const VolumeReading& reading, VolumeHeader& volume) {
  const Eigen::Vector3d signs = space_signs(header, reading, volume.notes);
  const double scale = nrrd_unit_mm(header, reading, volume.notes);
  const Eigen::Matrix3d linear = nrrd_directions(header, axes);
  volume.index_to_ras_mm.linear() = scale * (signs.asDiagonal() * linear);
  volume.index_to_ras_mm.translation() = scale * signs.cwiseProduct(origin_of(header, axes, linear, volume.notes));
  check_frame(volume.index_to_ras_mm, header.has("spacedirections") ? "spacedirections" : "spacings", header.file,
              "; are the lengths in another unit? Say so with --unit", volume.notes);
}

}  // namespace

fs::path detached_file(const fs::path& header, const std::string& name, const std::string& field) {
  const std::string file = header.string();
  const auto refuse = [&](const std::string& what) { throw InputError(file + ": " + field + ": " + what); };
  if (name.empty()) refuse("names no file");
  if (name.starts_with("LIST") || name.find('%') != std::string::npos)
    refuse("the voxels lie in several files; save the volume as one file");
  if (name.find('\0') != std::string::npos || name.size() > 1024) refuse("no name of a file");
  const fs::path relative = fs::path(name).lexically_normal();
  if (relative.is_absolute() || relative.begin()->string() == ".." || name.find('\\') != std::string::npos)
    refuse("leads out of the header's own folder; put the voxel file beside the header and name it alone");
  const fs::path data = header.parent_path() / relative;
  std::error_code error;
  if (!fs::is_regular_file(data, error)) refuse("the voxel file it names is not beside the header");
  if (fs::equivalent(data, header, error)) refuse("names the header itself");
  return data;
}

VolumeHeader nrrd_volume_header(const fs::path& path, const VolumeReading& reading) {
  const NrrdFields header = read_nrrd_fields(path);
  VolumeHeader volume;
  volume.format = "NRRD";
  const Axes axes = read_axes(header);
  const long long components = axes.sizes.size() == 4 ? axes.sizes[static_cast<std::size_t>(axes.component_axis)] : 1;
  for (std::size_t n = 0; n < 3; ++n) volume.size[n] = static_cast<int>(axes.sizes[axes.spatial[n]]);
  check_size({volume.size[0], volume.size[1], volume.size[2]}, components, "sizes", header.file);
  volume.components = static_cast<int>(components);
  volume.component_axis = axes.component_axis;
  read_nrrd_frame(header, axes, reading, volume);
  volume.segments = nrrd_segments(header, volume.components, volume.notes);
  if (const auto offset = header.keys.find("Segmentation_ReferenceImageExtentOffset"); offset != header.keys.end())
    volume.cut_out = offset->second.text.find_first_of("123456789") != std::string::npos;
  volume.segmentation = !volume.segments.empty();
  volume.block = voxel_block(header, path);
  return volume;
}

}  // namespace trocar
