// The film of an attempt on the desk: what is said of it, its page, and the part of it that a player asks for. Thread:
// any.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trainees/desk/pages/page_frame.h"
#include "trainees/desk/queries/views.h"

namespace trocar::review {

/// Section of the attempt page: leads to the film's page. "" without a recording.
std::string film_section(const AttemptView& view, const Frame& frame);

/// Progress, player or button. Renews itself while the film is made.
std::string film_page(const AttemptView& view, Frame frame);

/// A part of a file: from, how many.
struct ByteRange {
  std::uint64_t from = 0, count = 0;
  bool operator==(const ByteRange&) const = default;
};
inline constexpr std::uint64_t kMostAtOnce = 4U << 20U;  ///< bytes of an answer; players ask for more when they need it

/// What "bytes=0-499", "bytes=500-" or "bytes=-500" asks of a file of that size, cut to kMostAtOnce; nothing: it cannot
/// be had (416). Several parts at once are not given: then, and for what is no such header, `whole` says that the
/// answer is the file from its beginning.
std::optional<ByteRange> asked_range(const std::string& header, std::uint64_t size, bool& whole);

}  // namespace trocar::review
