// The voxels of a volume file as a stream of values in stored order; nothing larger than a block is held.
//
// Thread: any, not the tick (file I/O).
#pragma once

#include <functional>
#include <span>

#include "tissue/imaging/volumes/volume_header.h"
#include "tissue/progress.h"

namespace trocar {

/// Whether the file can hold `count` values, told from its length, before anybody makes room for them.
/// @throws InputError "FILE: data: the file ends after N of M bytes", "... too short"
void check_length(const VoxelBlock& block, std::uint64_t count);

/// Hands over all values in stored order, slope and intercept applied, in pieces of at most 16384.
/// @returns whether the file holds more behind the last value
/// @throws InputError naming file and place: missing or damaged data, text that is no number
bool stream_voxels(const VoxelBlock& block, std::uint64_t count, const Progress& progress,
                   const std::function<void(std::span<const double>)>& take);

}  // namespace trocar
