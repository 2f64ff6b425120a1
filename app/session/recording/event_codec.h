// EVENTS payload: events with their doubles exactly as they were, uncompressed.
//
// payload = u32 count, then per event: f64 t, u8 severity, i32 object, f64 value, 3 f64 tip, u16 and bytes of type, u16
// and bytes of unit. Little-endian.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scoring/trace.h"

namespace trocar {

/// @throws InputError when a type or unit is longer than 65535 bytes.
std::string encode_events(std::span<const Event> events);

/// @throws InputError saying what is wrong with the payload.
std::vector<Event> decode_events(std::string_view payload);

}  // namespace trocar
