// Arrays of numbers as files store them: ten types, two byte orders.
//
// Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/quantities.h"

namespace trocar {

enum class NumberType { kNone, kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

/// Bytes of one value; 0 for kNone.
std::size_t bytes_of(NumberType type);
bool is_whole(NumberType type);

/// @param raw a whole number of values
std::vector<double> stored_reals(std::string_view raw, NumberType type, bool big_endian);
/// As above for counts and indices; unsigned 64-bit values beyond the signed range come out negative.
/// @param type a whole one
std::vector<std::int64_t> stored_wholes(std::string_view raw, NumberType type, bool big_endian);

/// x y z, x y z ... as points. @throws InputError naming the file and the vertex when one is not finite or far beyond
/// any unit
std::vector<Vec3> points_from(const std::vector<double>& values, const std::string& file);

}  // namespace trocar
