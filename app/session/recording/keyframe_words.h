// A keyframe but for its shape as 64-bit words, field by field: what the codec takes differences of. Internal to the
// recorder.
//
// Of DirectorStatus every bit is kept; poses, contacts and marks are rounded to single precision (some 0.03 um). Words
// do not depend on how the compiler lays out a struct. Their order is the format: whoever changes it raises
// kKeyframeVersion (tissue_codec.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/session/recording/tissue_keyframe.h"

namespace trocar {

std::vector<std::uint64_t> words_of(const TissueKeyframe& keyframe);

/// Fills all but period and shape. @throws InputError when words are missing, left over or out of their range.
void read_words(std::span<const std::uint64_t> words, TissueKeyframe& keyframe);

}  // namespace trocar
