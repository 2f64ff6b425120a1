#include "trainees/desk/pages/compare_moment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "trainees/desk/pages/charts.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string base_of(const CompareView& view) {
  return "/compare/" + url_part(view.left.result.uuid) + "/" + url_part(view.right.result.uuid);
}

std::string href_of(const CompareView& view, double t_s, int aligned) {
  return base_of(view) + "?t=" + fixed_text(t_s, 2) + ("&amp;by=" + std::to_string(aligned)) + "#moment";
}

double length_of(const AttemptView& view) { return view.trace ? length_s(*view.trace) : 0; }

/// "12.5 s", and where the run is no more or not yet.
std::string time_words(double t_s, double length) {
  if (t_s < 0) return "not begun: its beginning is shown";
  if (t_s > length) return "over since " + fixed_text(length, 1) + " s: its end is shown";
  return fixed_text(t_s, 1) + " s";
}

std::string force_words(const AttemptView& view, double t_s) {
  const TraceSample* sample = view.trace && t_s >= 0 && t_s <= length_of(view) ? sample_at(*view.trace, t_s) : nullptr;
  return sample ? ", " + fixed_text(sample->force_T.norm(), 2) + " N at the tip" : "";
}

std::string side(const AttemptView& view, const std::string& words, double t_s, double shift) {
  const std::string caption = escape_html(words) + ": <output class=\"at\">" +
                              escape_html(time_words(t_s, length_of(view)) + force_words(view, t_s)) + "</output>";
  if (!view.picture)
    return "<figure><p class=\"empty\">No picture: there is no recording of it, or this desk runs without "
           "graphics.</p><figcaption>" +
           caption + "</figcaption></figure>";
  const std::string base = "/attempt/" + url_part(view.result.uuid) + "/picture.png?t=";
  const double inside = std::clamp(t_s, 0.0, length_of(view));
  return "<figure><img class=\"scope follows\" width=\"800\" height=\"450\" data-base=\"" + base + "\" data-shift=\"" +
         fixed_text(shift, 2) + "\" data-length=\"" + fixed_text(length_of(view), 2) + "\" src=\"" + base +
         fixed_text(inside, 2) + "\" alt=\"" + escape_html(words + " at " + fixed_text(inside, 1) + " s") +
         "\"/><figcaption>" + caption + "</figcaption></figure>";
}

std::string align_field(const std::vector<SharedMark>& marks, int aligned) {
  if (marks.empty()) return "";
  std::vector<Choice> choices = {{"0", "their own beginning"}};
  for (std::size_t i = 0; i < marks.size(); ++i) choices.emplace_back(std::to_string(i + 1), marks[i].words);
  return select_field("by", "by", "Laid on each other at", choices, std::to_string(aligned));
}

std::string steps(const CompareView& view, const std::vector<SharedMark>& marks, double top_s) {
  static constexpr std::array<std::pair<double, const char*>, 4> kSteps = {{{-5,
                                                                             "\xE2\x88\x92"
                                                                             "5 s"},
                                                                            {-1,
                                                                             "\xE2\x88\x92"
                                                                             "1 s"},
                                                                            {1, "+1 s"},
                                                                            {5, "+5 s"}}};
  std::string out;
  for (const auto& [by, words] : kSteps)
    out += "<a class=\"button\" href=\"" + href_of(view, std::clamp(view.t_s + by, 0.0, top_s), view.aligned) + "\">" +
           escape_html(words) + "</a>";
  const SharedMark *before = nullptr, *after = nullptr;
  int before_at = 0, after_at = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i].left_s < view.t_s - 0.02) before = &marks[i], before_at = static_cast<int>(i + 1);
    if (marks[i].left_s > view.t_s + 0.02 && after == nullptr) after = &marks[i], after_at = static_cast<int>(i + 1);
  }
  const auto to = [&](const SharedMark* mark, int at, const std::string& words) {
    if (mark)
      out += "<a class=\"button\" href=\"" + href_of(view, mark->left_s, at) + "\">" +
             escape_html(words + mark->words) + "</a>";
  };
  to(before, before_at, "\xE2\x86\x90 both at ");
  to(after, after_at, "both at ");
  return "<p class=\"steps\">" + out + "</p>";
}

}  // namespace

std::vector<SharedMark> shared_marks(const AttemptView& left, const AttemptView& right) {
  const auto times = [](const AttemptView& view) {
    std::map<std::string, std::vector<double>> out;
    for (const Event& event : view.result.events)
      if (event.severity == Severity::kInfo && std::isfinite(event.t_s) && event.type != event_type::kMarked &&
          event.type != event_type::kMessage)
        out[event.type].push_back(event.t_s - view.begin_s());
    return out;
  };
  const auto in_left = times(left), in_right = times(right);
  std::vector<SharedMark> out;
  for (const auto& [type, at] : in_left) {
    const auto other = in_right.find(type);
    if (other == in_right.end()) continue;
    for (std::size_t n = 0; n < std::min(at.size(), other->second.size()); ++n)
      out.push_back({words_of(type) + " " + std::to_string(n + 1), at[n], other->second[n]});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const SharedMark& a, const SharedMark& b) { return a.left_s < b.left_s; });
  return out;
}

double shift_s(const std::vector<SharedMark>& marks, int aligned) {
  if (aligned < 1 || static_cast<std::size_t>(aligned) > marks.size()) return 0;
  const SharedMark& mark = marks[static_cast<std::size_t>(aligned - 1)];
  return mark.right_s - mark.left_s;
}

int start_mark(const std::vector<SharedMark>& marks) {
  const auto at =
      std::find_if(marks.begin(), marks.end(), [](const SharedMark& mark) { return mark.words == "Start 1"; });
  return at == marks.end() ? 0 : 1 + static_cast<int>(at - marks.begin());
}

std::string compare_moment_section(const CompareView& view) {
  if (!view.left.trace && !view.right.trace) return "";
  const std::vector<SharedMark> marks = shared_marks(view.left, view.right);
  const double shift = shift_s(marks, view.aligned);
  const double top_s = std::max({length_of(view.left), length_of(view.right) - shift, 0.1});
  const std::string pictures = "<div class=\"two even\"><div>" + side(view.left, view.left_words, view.t_s, 0) +
                               "</div><div>" + side(view.right, view.right_words, view.t_s + shift, shift) +
                               "</div></div>";
  const std::string form = "<form class=\"scrub\" id=\"together\" method=\"get\" action=\"" + base_of(view) +
                           "#moment\"><label for=\"both\">Time of the first</label><input id=\"both\" name=\"t\" "
                           "type=\"range\" data-words=\"not begun; over\" min=\"0\" max=\"" +
                           fixed_text(top_s, 1) + "\" step=\"0.1\" value=\"" + fixed_text(view.t_s, 1) + "\"/>" +
                           align_field(marks, view.aligned) + "<button>Show</button></form>";
  const std::string said = shift == 0 ? "Both from their own beginning."
                                      : "The second is shown " + fixed_text(std::abs(shift), 1) + " s " +
                                            (shift > 0 ? "later" : "earlier") +
                                            " than the first, so that both are at the chosen mark together.";
  return section("moment", "Pictures at the same moment",
                 pictures + form + steps(view, marks, top_s) + "<p class=\"dim\"><small>" + said +
                     " The first picture of an attempt takes some seconds.</small></p>");
}

}  // namespace trocar::review
