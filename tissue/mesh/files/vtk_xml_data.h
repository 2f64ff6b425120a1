// The data arrays of VTK XML files: text, base64 or raw, plain or compressed with zlib.
//
// Every length that the file states is checked against what is there before room is made. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tissue/mesh/files/stored_numbers.h"

namespace trocar {

/// How all the arrays of a file are packed.
struct VtkXmlPacking {
  bool big_endian = false;
  std::size_t header_bytes = 4;  ///< of each length in front of the data
  bool compressed = false;       ///< zlib, in blocks
};

/// @param packed from the first letter or byte of the array on; more may follow
/// @throws InputError naming the file: cut off, no base64, damaged zlib data
std::string unpacked_array(std::string_view packed, bool base64, const VtkXmlPacking& packing, const std::string& file);

/// "Float32" ...; kNone for what is not known.
NumberType vtk_xml_type(std::string_view name);

}  // namespace trocar
