// The section of the attempt page that shows where the tip was and where it pressed, painted on the scene.
#include <algorithm>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/markup/html.h"

namespace trocar::review {

std::string heat_section(const AttemptView& view) {
  if (!view.trace || view.trace->samples.empty() || !view.heat) return "";
  const bool touched = std::any_of(view.trace->samples.begin(), view.trace->samples.end(),
                                   [](const TraceSample& s) { return s.contact; });
  const std::string path = "/attempt/" + url_part(view.result.uuid), of = view.heat_of_force ? "force" : "time";
  const auto choice = [&](bool force, const std::string& words) {
    return force == view.heat_of_force
               ? "<strong>" + words + "</strong>"
               : "<a href=\"" + path + "?heat=" + (force ? "force" : "time") + "#heat\">" + words + "</a>";
  };
  std::string out =
      "<p>" + choice(false, "Time near the place") + " \xC2\xB7 " + choice(true, "Largest force there") + "</p>";
  if (view.heat_of_force && !touched) {
    out += "<p class=\"empty\">Nothing was touched in this attempt.</p>";
  } else {
    const std::string what = view.heat_of_force ? "largest contact force" : "time of the tip near by";
    const auto picture = [&](const std::string& from, const std::string& words) {
      return "<figure><img class=\"scope patient\" width=\"800\" height=\"450\" loading=\"lazy\" src=\"" + path +
             "/heat.png?of=" + of + "&amp;view=" + from + "\" alt=\"Map of the " + what + ", " + words +
             "\"/><figcaption>" + words + "</figcaption></figure>";
    };
    out += "<div class=\"two even\"><div>" + picture("scope", "as the scope saw it") + "</div><div>" +
           picture("overview", "overview") + "</div></div>";
  }
  out += view.heat_of_force ? "<p class=\"dim\">Painted: the largest force of the scene on the instrument while its "
                              "tip touched within 3 mm of the place, in virtual newtons of "
                              "the simulated plant. On a board the place is that under the tip. Grey: not touched.</p>"
                            : "<p class=\"dim\">Painted: seconds for which the tip was within 3 mm of the place; on a "
                              "board, over the place at any height (blocks are left out). Grey: less than 2 % "
                              "of the most.</p>";
  return section("heat", "Map on the scene",
                 out +
                     "<p class=\"dim\"><small>Both pictures share one scale, the bar in them (viridis: even steps, and "
                     "to be told apart without "
                     "colours). Blue is little, yellow is much.</small></p>");
}

}  // namespace trocar::review
