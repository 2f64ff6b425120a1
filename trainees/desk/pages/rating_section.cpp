#include <algorithm>

#include "trainees/desk/pages/attempt_parts.h"
#include "trainees/markup/html.h"
#include "trainees/records/rating_scales.h"

namespace trocar::review {
namespace {

std::string sheet_row(const RatingSheet& sheet, const RatingScale& scale) {
  std::string row = "<tr><th scope=\"row\">" + printed_html(sheet.rater) + "</th>";
  for (const RatingItem& item : scale.items) {
    const auto value = sheet.values.find(item.name);
    row += number_cell(value == sheet.values.end() ? "-" : number_text(value->second));
  }
  const auto total = sheet.total(scale);
  return row + number_cell(total ? number_text(*total) : "not all items") + "<td>" + date_html(sheet.utc) +
         "</td></tr>";
}

std::string totals_text(const std::vector<RatingSheet>& sheets, const RatingScale& scale) {
  std::vector<double> totals;
  for (const RatingSheet& sheet : sheets)
    if (const auto total = sheet.total(scale)) totals.push_back(*total);
  if (totals.size() < 2) return "";
  double sum = 0;
  for (const double total : totals) sum += total;
  const auto [least, most] = std::minmax_element(totals.begin(), totals.end());
  return "<p>Mean sum " + fixed_text(sum / static_cast<double>(totals.size()), 1) + ", from " + number_text(*least) +
         " to " + number_text(*most) + ", n = " + std::to_string(totals.size()) + " raters.</p>";
}

std::string scale_table(const AttemptView& view, const RatingScale& scale) {
  const auto sheets = rating_sheets(view.ratings, scale);
  if (sheets.empty()) return "";
  std::vector<std::string> head = {"Rated by"};
  for (const RatingItem& item : scale.items) head.push_back(">" + words_of(item.name));
  head.insert(head.end(), {">Sum", "When"});
  std::string rows;
  for (const RatingSheet& sheet : sheets) rows += sheet_row(sheet, scale);
  const std::string range = std::to_string(scale.least) + " to " + std::to_string(scale.most);
  return table(scale.name + ", " + scale.title + ": each item " + range + ", the newest value of each rater",
               head_cells(head), rows) +
         totals_text(sheets, scale);
}

/// Rows of other scales, as they were given.
std::string other_ratings(const AttemptView& view) {
  std::string rows;
  for (const Rating& r : view.ratings) {
    if (r.scale == goals_scale().name) continue;
    rows += "<tr><th scope=\"row\">" + escape_html(r.scale) + "</th>" + cell(r.item) +
            number_cell(number_text(r.value)) + "<td>" + printed_html(r.rater) + "</td><td>" + date_html(r.utc) +
            "</td></tr>";
  }
  return rows.empty() ? "" : table("Other scales", head_cells({"Scale", "Item", ">Value", "By", "When"}), rows);
}

std::string item_field(const RatingItem& item, const RatingScale& scale, const Frame& frame) {
  const std::string name = escape_html(item.name), given = kept(frame, "rate", item.name);
  const auto choice = [&](const std::string& value, const std::string& words, bool chosen) {
    return "<label><input type=\"radio\" name=\"" + name + "\" value=\"" + value + "\"" +
           (chosen ? " checked=\"checked\"" : "") + "/>" + words + "</label>";
  };
  std::string out =
      "<fieldset class=\"rate\"><legend>" + escape_html(words_of(item.name)) + "</legend><p class=\"dim\"><small>";
  for (std::size_t i = 0; i < item.anchors.size(); ++i)
    out += (i == 0 ? "" : " ") + std::to_string(1 + 2 * i) + ": " + escape_html(item.anchors[i]) + ".";
  out += "</small></p><p>" + choice("", "not rated", given.empty());
  for (int value = scale.least; value <= scale.most; ++value)
    out += choice(std::to_string(value), std::to_string(value), given == std::to_string(value));
  return out + "</p></fieldset>";
}

std::string rating_form(const AttemptView& view, const RatingScale& scale, const Frame& frame) {
  std::string out =
      std::string("<details") + (frame.refused.form == "rate" ? " open=\"open\"" : "") +
      "><summary>Rate this attempt on " + escape_html(scale.name) + "</summary>" +
      form_begin("/attempt/" + url_part(view.result.uuid) + "/rate", frame) +
      "<p class=\"dim\">From the replay above. Leave at \"not rated\" what cannot be seen, such as two hands where one "
      "instrument was used. The program fills in nothing.</p><input type=\"hidden\" name=\"scale\" value=\"" +
      escape_html(scale.name) + "\"/>";
  for (const RatingItem& item : scale.items) out += item_field(item, scale, frame);
  return out + why_refused(frame, "rate") + "<p><button>Record the rating</button></p></form></details>";
}

}  // namespace

std::string rating_section(const AttemptView& view, const Frame& frame) {
  const RatingScale& scale = goals_scale();
  std::string out = scale_table(view, scale) + other_ratings(view);
  if (!frame.may_write) return out.empty() ? "" : section("ratings", "Ratings by people", out);
  if (out.empty()) out = "<p class=\"dim\">Nobody has rated this attempt yet.</p>";
  return section("ratings", "Ratings by people", out + rating_form(view, scale, frame));
}

}  // namespace trocar::review
