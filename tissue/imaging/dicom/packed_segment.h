// A segment in a string of bytes: what a child process tells of its name, colour and codes. Thread: any.
#pragma once

#include "tissue/imaging/dicom/packed_bytes.h"
#include "tissue/imaging/labels/segment.h"

namespace trocar {

inline void put_segment(PackedWriter& out, const Segment& segment) {
  out.put(static_cast<std::int32_t>(segment.number));
  out.put_text(segment.name);
  out.put(static_cast<std::uint8_t>(segment.colour.has_value()));
  for (const std::uint8_t part : segment.colour.value_or(SegmentColour{})) out.put(part);
  out.put(static_cast<std::uint64_t>(segment.codes.size()));
  for (const SegmentCode& code : segment.codes)
    for (const std::string* text : {&code.role, &code.scheme, &code.value, &code.meaning}) out.put_text(*text);
}

inline Segment get_segment(PackedReader& in) {
  Segment segment;
  segment.number = in.get<std::int32_t>();
  segment.name = std::string(in.get_text());
  const bool coloured = in.get<std::uint8_t>() != 0;
  SegmentColour colour{};
  for (std::uint8_t& part : colour) part = in.get<std::uint8_t>();
  if (coloured) segment.colour = colour;
  for (std::uint64_t left = in.get_count(32); left > 0; --left) {
    SegmentCode& code = segment.codes.emplace_back();
    for (std::string* text : {&code.role, &code.scheme, &code.value, &code.meaning}) *text = std::string(in.get_text());
  }
  return segment;
}

}  // namespace trocar
