#include "tissue/imaging/volumes/meta_image_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "haptics/input_error.h"
#include "tissue/imaging/volumes/byte_stream.h"
#include "tissue/imaging/volumes/nrrd_header.h"
#include "tissue/imaging/volumes/volume_frame.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMetaBytes = 64 << 10;

struct Value {
  std::string text;
  int line = 0;
};

struct MetaText {
  std::string file;
  std::map<std::string, Value> keys;
  std::uint64_t data_offset = 0;

  bool has(const std::string& key) const { return keys.contains(key); }
  /// The first of these keys that is there; "" when none is.
  std::string first_of(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (has(name)) return name;
    return "";
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& what) const {
    const auto found = keys.find(key);
    if (found == keys.end()) throw InputError(file + ": " + key + ": " + what);
    throw InputError(file, found->second.line, 1, key + ": " + what);
  }
  const std::string& wanted(const std::string& key) const {
    if (!has(key)) refuse(key, "missing");
    return keys.at(key).text;
  }
};

std::string trimmed_value(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Lines "Key = value" down to ElementDataFile, behind which the voxels of an .mha begin.
MetaText read_keys(const fs::path& path) {
  MetaText meta{.file = path.string(), .keys = {}};
  const auto bytes = open_plain(path, 0);
  std::string text(kMostMetaBytes, '\0');
  text.resize(bytes->read(reinterpret_cast<unsigned char*>(text.data()), text.size()));
  std::size_t place = 0;
  for (int number = 1; place < text.size(); ++number) {
    const auto end = std::min(text.find('\n', place), text.size());
    const std::string line = trimmed_value(text.substr(place, end - place));
    place = std::min(end + 1, text.size());
    if (line.empty()) continue;
    const auto equals = line.find('=');
    if (equals == std::string::npos) throw InputError(meta.file, number, 1, "no line \"Key = value\"");
    const std::string key = trimmed_value(line.substr(0, equals));
    if (!meta.keys.try_emplace(key, Value{trimmed_value(line.substr(equals + 1)), number}).second)
      throw InputError(meta.file, number, 1, "a key that was given before");
    if (key != "ElementDataFile") continue;
    meta.data_offset = place;
    return meta;
  }
  meta.refuse("ElementDataFile", "missing within the first 64 KiB");
}

std::vector<double> numbers(const MetaText& meta, const std::string& key, std::size_t count) {
  const std::string& text = meta.wanted(key);
  std::vector<double> values;
  for (const char *place = text.data(), *end = place + text.size(); place != end;) {
    if (*place == ' ' || *place == '\t') {
      ++place;
      continue;
    }
    if (*place == '+') ++place;
    double value = 0;
    const auto [stop, error] = std::from_chars(place, end, value);
    if (error != std::errc() || values.size() == count) meta.refuse(key, std::to_string(count) + " numbers are wanted");
    values.push_back(value);
    place = stop;
  }
  if (values.size() != count) meta.refuse(key, std::to_string(count) + " numbers are wanted");
  return values;
}

long long whole_value(const MetaText& meta, const std::string& key, long long least, long long most) {
  const double value = numbers(meta, key, 1)[0];
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) || value != std::floor(value))
    meta.refuse(key, "no whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<long long>(value);
}

bool flag(const MetaText& meta, const std::string& key, bool otherwise) {
  if (!meta.has(key)) return otherwise;
  const std::string text = lower_case(meta.wanted(key));
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  meta.refuse(key, "neither True nor False");
}

VoxelType meta_voxel_type(const MetaText& meta) {
  using enum VoxelType;
  static const std::map<std::string, VoxelType> types{
      {"MET_CHAR", kInt8},     {"MET_UCHAR", kUint8},   {"MET_SHORT", kInt16},     {"MET_USHORT", kUint16},
      {"MET_INT", kInt32},     {"MET_UINT", kUint32},   {"MET_LONG_LONG", kInt64}, {"MET_ULONG_LONG", kUint64},
      {"MET_FLOAT", kFloat32}, {"MET_DOUBLE", kFloat64}};
  const auto found = types.find(meta.wanted("ElementType"));
  if (found != types.end()) return found->second;
  if (meta.wanted("ElementType").starts_with("MET_LONG") || meta.wanted("ElementType").starts_with("MET_ULONG"))
    meta.refuse("ElementType", "4 or 8 bytes, which depends on the machine that wrote it; save it as MET_INT");
  meta.refuse("ElementType", "no number type that is read here");
}

void read_scale(const MetaText& meta, VolumeHeader& volume) {
  const std::string slope = meta.first_of({"ElementToIntensityFunctionSlope"});
  const std::string offset = meta.first_of({"ElementToIntensityFunctionOffset"});
  if (!slope.empty()) volume.block.slope = numbers(meta, slope, 1)[0];
  if (!offset.empty()) volume.block.intercept = numbers(meta, offset, 1)[0];
  if (!std::isfinite(volume.block.slope) || volume.block.slope == 0 || !std::isfinite(volume.block.intercept))
    meta.refuse(slope.empty() ? offset : slope, "zero or not finite");
  if (volume.block.slope != 1 || volume.block.intercept != 0)
    volume.notes.push_back("values multiplied by " + plain(volume.block.slope) + " plus " +
                           plain(volume.block.intercept) + ", as ElementToIntensityFunction says");
}

void read_block(const MetaText& meta, const fs::path& path, VolumeHeader& volume) {
  VoxelBlock& block = volume.block;
  block.type = meta_voxel_type(meta);
  const std::string order = meta.first_of({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
  block.swapped = !order.empty() && flag(meta, order, false);
  const bool packed = flag(meta, "CompressedData", false);
  block.encoding = !flag(meta, "BinaryData", true) ? VoxelEncoding::kText
                   : packed                        ? VoxelEncoding::kDeflated
                                                   : VoxelEncoding::kRaw;
  const std::string& name = meta.wanted("ElementDataFile");
  const bool local = lower_case(name) == "local";
  block.file = local ? path : detached_file(path, name, "ElementDataFile");
  block.offset = local ? meta.data_offset : 0;
  if (meta.has("HeaderSize")) {
    const long long skip = whole_value(meta, "HeaderSize", -1, 1LL << 40);
    if (skip < 0 && block.encoding != VoxelEncoding::kRaw) meta.refuse("HeaderSize", "-1 goes with raw data only");
    block.last_in_file = skip < 0;
    if (skip > 0) block.offset += static_cast<std::uint64_t>(skip);
  }
  if (lower_case(name).ends_with(".dcm") || lower_case(name).ends_with(".png"))
    meta.refuse("ElementDataFile", "names a picture of its own format, not raw voxels");
}

/// "RAI": axis by axis where from, in the words of the format; the directions as LPS columns.
std::optional<Eigen::Matrix3d> directions_of_letters(const std::string& letters) {
  if (letters.size() != 3) return std::nullopt;
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view from = "RLAPIS";  // from right to left is +x of LPS
    const auto place = from.find(letters[static_cast<std::size_t>(axis)]);
    if (place == std::string_view::npos) return std::nullopt;
    directions(static_cast<int>(place / 2), axis) = place % 2 == 0 ? 1 : -1;
  }
  if (std::abs(directions.determinant()) != 1) return std::nullopt;
  return directions;
}

Eigen::Matrix3d meta_directions(const MetaText& meta, std::vector<std::string>& notes) {
  const std::string key = meta.first_of({"TransformMatrix", "Rotation", "Orientation"});
  const auto letters =
      meta.has("AnatomicalOrientation") ? directions_of_letters(meta.wanted("AnatomicalOrientation")) : std::nullopt;
  if (key.empty()) {
    if (!letters)
      notes.push_back(
          "neither TransformMatrix nor AnatomicalOrientation: axes to the left, the back and the head (LPS) assumed");
    return letters.value_or(Eigen::Matrix3d::Identity());
  }
  const std::vector<double> matrix = numbers(meta, key, 9);
  Eigen::Matrix3d directions;
  for (std::size_t n = 0; n < 9; ++n) directions(static_cast<int>(n % 3), static_cast<int>(n / 3)) = matrix[n];
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(directions.col(axis).norm() - 1) < 1e-2)) meta.refuse(key, "its vectors have not length 1");
  if (letters && (letters->transpose() * directions).diagonal().minCoeff() < 0.5)
    notes.push_back("AnatomicalOrientation and " + key + " contradict each other; " + key + " was used");
  return directions;
}

Eigen::Vector3d triple(const MetaText& meta, const std::string& key) {
  const std::vector<double> values = numbers(meta, key, 3);
  return {values[0], values[1], values[2]};
}

/// What the image would measure in other units, for a person who knows the organ.
std::string unit_hint(const Eigen::Vector3d& spacing, const std::array<int, 3>& size) {
  const Eigen::Vector3d whole = spacing.cwiseProduct(Eigen::Vector3d(size[0], size[1], size[2]));
  std::string hint = "; the image measures " + plain(whole[0]) + " x " + plain(whole[1]) + " x " + plain(whole[2]) +
                     ": of which unit? Say so with --unit (";
  const bool large = spacing.maxCoeff() > 100;  // millimetres would be metres: no unit above them will do
  std::string choices;
  for (const char* unit : large ? std::vector<const char*>{"um"} : std::vector<const char*>{"cm", "dm", "m"})
    choices += (choices.empty() ? "" : ", ") + std::string(unit) + " makes it " +
               plain(whole.maxCoeff() * millimetres_in(unit, "", "")) + " mm long";
  return hint + choices + ")";
}

double meta_unit_mm(const MetaText& meta, const VolumeReading& reading, std::vector<std::string>& notes) {
  if (!reading.unit.empty()) {
    notes.push_back("lengths read in " + reading.unit + ", as was asked for");
    return millimetres_in(reading.unit, "--unit", meta.file);
  }
  const std::string key = meta.first_of({"DistanceUnits", "ElementSpacingUnit"});
  if (key.empty() || meta.wanted(key) == "?") return 1;
  return millimetres_in(meta.wanted(key), key, meta.file);
}

void read_meta_frame(const MetaText& meta, const VolumeReading& reading, VolumeHeader& volume) {
  const std::string key = meta.first_of({"ElementSpacing", "ElementSize"});
  if (key.empty()) meta.refuse("ElementSpacing", "missing: how large is a voxel?");
  const Eigen::Vector3d spacing = triple(meta, key);
  if (spacing.minCoeff() < 0)
    meta.refuse(key,
                "negative along an axis: whether it runs the other way or is a slip nobody can tell; "
                "directions belong into TransformMatrix");
  const double scale = meta_unit_mm(meta, reading, volume.notes);
  const Eigen::Matrix3d directions = meta_directions(meta, volume.notes);
  const Eigen::Vector3d lps_signs(-1, -1, 1);
  const std::string origin = meta.first_of({"Offset", "Position", "Origin"});
  if (origin.empty()) volume.notes.push_back("the header gives no Offset; (0, 0, 0) assumed");
  const Eigen::Vector3d place = origin.empty() ? Eigen::Vector3d::Zero().eval() : triple(meta, origin);
  volume.index_to_ras_mm.linear() = scale * (lps_signs.asDiagonal() * directions * spacing.asDiagonal());
  volume.index_to_ras_mm.translation() = scale * lps_signs.cwiseProduct(place);
  check_frame(volume.index_to_ras_mm, key, meta.file, unit_hint(spacing, volume.size), volume.notes);
  if (meta.has("CenterOfRotation") && triple(meta, "CenterOfRotation") != Eigen::Vector3d::Zero())
    volume.notes.push_back("CenterOfRotation is not the origin; it was left out, as ITK does");
}

void read_meta_size(const MetaText& meta, VolumeHeader& volume) {
  const long long dimensions = whole_value(meta, "NDims", 1, 10);
  if (dimensions != 3) meta.refuse("NDims", std::to_string(dimensions) + " dimensions; a volume has 3");
  const std::vector<double> size = numbers(meta, "DimSize", 3);
  std::array<long long, 3> extent{};
  for (std::size_t n = 0; n < 3; ++n) {
    if (!(size[n] >= 1 && size[n] <= 1 << 20) || size[n] != std::floor(size[n]))
      meta.refuse("DimSize", "no whole numbers from 1 to 1048576");
    extent[n] = static_cast<long long>(size[n]);
    volume.size[n] = static_cast<int>(extent[n]);
  }
  const long long channels =
      meta.has("ElementNumberOfChannels") ? whole_value(meta, "ElementNumberOfChannels", 1, 1 << 16) : 1;
  check_size(extent, channels, "DimSize", meta.file);
  volume.components = static_cast<int>(channels);
  volume.component_axis = channels > 1 ? 0 : 3;
}

}  // namespace

VolumeHeader meta_image_header(const fs::path& path, const VolumeReading& reading) {
  const MetaText meta = read_keys(path);
  if (meta.has("ObjectType") && lower_case(meta.wanted("ObjectType")) != "image") meta.refuse("ObjectType", "no image");
  VolumeHeader volume;
  volume.format = "MetaImage";
  read_meta_size(meta, volume);
  read_meta_frame(meta, reading, volume);
  read_block(meta, path, volume);
  read_scale(meta, volume);
  if (meta.has("Modality") && meta.wanted("Modality") == "MET_MOD_CT") volume.modality = "CT";
  if (meta.has("Modality") && meta.wanted("Modality") == "MET_MOD_MR") volume.modality = "MR";
  return volume;
}

}  // namespace trocar
