#include "tissue/mesh/files/stored_numbers.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "haptics/input_error.h"

namespace trocar {
namespace {

template <typename Stored>
Stored value_at(const char* at, bool big_endian) {
  std::array<char, sizeof(Stored)> bytes{};
  std::memcpy(bytes.data(), at, sizeof(Stored));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  Stored value;
  std::memcpy(&value, bytes.data(), sizeof(Stored));
  return value;
}

template <typename Stored, typename Result>
std::vector<Result> values(std::string_view raw, bool big_endian) {
  std::vector<Result> result;
  result.reserve(raw.size() / sizeof(Stored));
  for (std::size_t at = 0; at + sizeof(Stored) <= raw.size(); at += sizeof(Stored))
    result.push_back(static_cast<Result>(value_at<Stored>(raw.data() + at, big_endian)));
  return result;
}

template <typename Result>
std::vector<Result> whole_values(std::string_view raw, NumberType type, bool big_endian) {
  switch (type) {
    case NumberType::kInt8:
      return values<std::int8_t, Result>(raw, big_endian);
    case NumberType::kUint8:
      return values<std::uint8_t, Result>(raw, big_endian);
    case NumberType::kInt16:
      return values<std::int16_t, Result>(raw, big_endian);
    case NumberType::kUint16:
      return values<std::uint16_t, Result>(raw, big_endian);
    case NumberType::kInt32:
      return values<std::int32_t, Result>(raw, big_endian);
    case NumberType::kUint32:
      return values<std::uint32_t, Result>(raw, big_endian);
    case NumberType::kInt64:
      return values<std::int64_t, Result>(raw, big_endian);
    case NumberType::kUint64:
      return values<std::uint64_t, Result>(raw, big_endian);
    default:
      return {};
  }
}

}  // namespace

std::size_t bytes_of(NumberType type) {
  constexpr std::array<std::size_t, 11> kBytes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

bool is_whole(NumberType type) {
  return type != NumberType::kNone && type != NumberType::kFloat32 && type != NumberType::kFloat64;
}

std::vector<double> stored_reals(std::string_view raw, NumberType type, bool big_endian) {
  if (type == NumberType::kFloat32) return values<float, double>(raw, big_endian);
  if (type == NumberType::kFloat64) return values<double, double>(raw, big_endian);
  return whole_values<double>(raw, type, big_endian);
}

std::vector<std::int64_t> stored_wholes(std::string_view raw, NumberType type, bool big_endian) {
  return whole_values<std::int64_t>(raw, type, big_endian);
}

std::vector<Vec3> points_from(const std::vector<double>& values, const std::string& file) {
  constexpr double kFarthest = 1e9;
  std::vector<Vec3> points;
  points.reserve(values.size() / 3);
  for (std::size_t n = 0; n + 3 <= values.size(); n += 3) {
    const Vec3 point(values[n], values[n + 1], values[n + 2]);
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthest)  // a maximum may step over a NaN
      throw InputError(file + ": vertex " + std::to_string(n / 3) + " is not finite or absurdly far away");
    points.push_back(point);
  }
  return points;
}

}  // namespace trocar
