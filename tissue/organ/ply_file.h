// The surface file of an organ: binary little-endian PLY, float32 vertices in metres, 32-bit vertex indices.
//
// Written in one fixed form, so that one surface is one sequence of bytes; read back strictly. Thread: any, not the
// tick.
#pragma once

#include <string>
#include <string_view>

#include "tissue/mesh/surface/triangle_surface.h"

namespace trocar {

std::string ply_bytes(const TriangleSurface& surface);

/// @param file name for messages
/// @throws InputError naming the file and the header line or element at fault: another form of PLY, too short or too
///         long, vertex not finite, index out of range
TriangleSurface parse_ply(std::string_view bytes, const std::string& file);

}  // namespace trocar
