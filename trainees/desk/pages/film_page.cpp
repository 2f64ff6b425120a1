#include "trainees/desk/pages/film_page.h"

#include <algorithm>

#include "trainees/desk/pages/pages.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

constexpr int kRefresh_s = 2;

std::string path_of(const AttemptView& view) { return "/attempt/" + url_part(view.result.uuid); }

std::string button(const AttemptView& view, const Frame& frame, const std::string& words) {
  return form_begin(path_of(view) + "/film", frame) + "<p><button>" + escape_html(words) + "</button></p></form>";
}

std::string megabytes(std::uint64_t bytes) { return fixed_text(static_cast<double>(bytes) / 1e6, 1) + " MB"; }

std::string content(const AttemptView& view, const Frame& frame) {
  const FilmState& film = view.film;
  const std::string file = path_of(view) + "/film.mp4";
  switch (film.stage) {
    case FilmState::Stage::kReady:
      return "<video class=\"scope\" controls=\"controls\" preload=\"metadata\" width=\"960\" height=\"540\" src=\"" +
             file + "\">This browser plays no film.</video><p>" + "<a href=\"" + file +
             "?save=1\" download=\"download\">Save the film</a> (MP4, " + megabytes(film.bytes) + ")</p>";
    case FilmState::Stage::kMaking:
      return "<p>" + escape_html(film.words) + "</p><p><progress max=\"100\" value=\"" +
             fixed_text(100 * std::clamp(film.share, 0.0, 1.0), 0) + "\">" +
             fixed_text(100 * std::clamp(film.share, 0.0, 1.0), 0) +
             " %</progress></p><p class=\"dim\">It is made in the background; you may leave this page.</p>";
    case FilmState::Stage::kFailed:
      return "<p class=\"error\">" + escape_html(film.words) + "</p>" + button(view, frame, "Try again");
    case FilmState::Stage::kNone:
      break;
  }
  if (!view.no_film.empty()) return "<p class=\"empty\">" + escape_html(view.no_film) + "</p>";
  return button(view, frame, "Make a film") +
         "<p class=\"dim\">The run with its display, as MP4. It takes about as long as the run, or some times "
         "that.</p>";
}

}  // namespace

std::string film_section(const AttemptView& view, const Frame& frame) {
  if (!view.trace) return "";
  if (view.film.stage == FilmState::Stage::kNone) return section("film", "Film", content(view, frame));
  const std::string words = view.film.stage == FilmState::Stage::kReady    ? "Watch the film"
                            : view.film.stage == FilmState::Stage::kMaking ? "Being made: see how far"
                                                                           : "It could not be made: see why";
  return section("film", "Film", "<p>" + link_html(path_of(view) + "/film", words) + "</p>");
}

std::string film_page(const AttemptView& view, Frame frame) {
  const bool making = view.film.stage == FilmState::Stage::kMaking;
  frame.title = "Film, " + view.exercise + " " + view.result.level + ", " + view.result.trainee;
  if (making) frame.refresh_s = kRefresh_s;
  const std::string every = making ? " data-every=\"" + std::to_string(kRefresh_s) + "\"" : "";
  return document(frame, "<div class=\"title\"><h1>Film</h1><p class=\"dim\">" +
                             link_html(path_of(view), view.exercise + " " + view.result.level) + ", " +
                             verbatim(view.result.trainee) + ", " + date_html(view.result.started_utc) +
                             "</p></div><div id=\"live\"" + every + ">" +
                             section("film", making ? "Being made" : "The run", content(view, frame)) + "</div>");
}

std::optional<ByteRange> asked_range(const std::string& header, std::uint64_t size, bool& whole) {
  whole = true;
  const ByteRange all{0, size};
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return all;
  const std::string text = header.substr(kUnit.size());
  const std::size_t dash = text.find('-');
  constexpr std::size_t kMostDigits = 18;
  const auto digits = [](const std::string& part) {
    return part.size() <= kMostDigits &&
           std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (dash == std::string::npos) return all;
  const std::string first = text.substr(0, dash), last = text.substr(dash + 1);
  if (!digits(first) || !digits(last) || (first.empty() && last.empty())) return all;
  whole = false;
  std::uint64_t from = 0, to = size;  // behind the last byte
  if (first.empty()) {
    const std::uint64_t tail = std::min<std::uint64_t>(std::stoull(last), size);
    if (tail == 0) return {};
    from = size - tail;
  } else {
    from = std::stoull(first);
    if (!last.empty()) {
      const std::uint64_t end = std::stoull(last);
      if (end < from) {
        whole = true;  // no range at all: as if none had been asked
        return all;
      }
      to = std::min(size, end + 1);
    }
    if (from >= size) return {};
  }
  return ByteRange{from, std::min(to - from, kMostAtOnce)};
}

}  // namespace trocar::review
