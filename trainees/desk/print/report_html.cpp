// A report as one HTML file: style and charts inside it, no script, nothing fetched; it prints as it stands.
#include "trainees/desk/print/html_file.h"
#include "trainees/desk/print/pdf_pages.h"
#include "trainees/desk/print/report.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar::printed {
namespace {

const char* class_of(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return "good";
    case Tone::kBad:
      return "bad";
    case Tone::kQuiet:
      return "quiet";
    case Tone::kPlain:
      break;
  }
  return "plain";
}

std::string percent(double share) { return fixed_text(100 * share, 1) + "%"; }

std::string html(const Heading& heading) {
  const std::string tag = heading.level == 1 ? "h2" : "h3";
  return "<" + tag + (heading.new_page ? " class=\"page\"" : "") + ">" + escape_html(heading.words) + "</" + tag + ">";
}

std::string html(const Paragraph& paragraph) {
  return std::string("<p class=\"") + class_of(paragraph.tone) + (paragraph.mark ? " point" : "") + "\">" +
         escape_html(paragraph.words) + "</p>";
}

std::string html(const Facts& facts) {
  std::string out = "<dl class=\"facts" + std::string(facts.mono ? " mono" : "") + "\" data-columns=\"" +
                    std::to_string(facts.columns) + "\">";
  for (const auto& [name, value] : facts.pairs)
    out += "<div><dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd></div>";
  return out + "</dl>";
}

std::string html(const Table& table) {
  if (table.rows.empty())
    return "<p class=\"quiet\">" + escape_html(table.caption.empty() ? "" : table.caption + ": ") +
           escape_html(table.none) + "</p>";
  std::string out =
      "<table><caption>" + escape_html(table.caption) + "</caption>" + column_widths(table.columns) + "<thead><tr>";
  for (const Column& column : table.columns)
    out += std::string("<th scope=\"col\"") + (column.number ? " class=\"n\"" : "") + ">" + escape_html(column.title) +
           "</th>";
  out += "</tr></thead><tbody>";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size() && i < table.columns.size(); ++i) {
      const Column& column = table.columns[i];
      out += std::string("<td class=\"") + class_of(row[i].tone) + (column.number ? " n" : "") +
             (column.mono ? " mono" : "") + "\">" +
             (row[i].svg.empty() ? escape_html(row[i].words) : svg::without_links(row[i].svg)) + "</td>";
    }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

std::string html(const Figures& figures) {
  std::string out = "<div class=\"figures\">";
  for (const Figure& figure : figures.all)
    out += "<figure style=\"width:" + percent(figure.share) + "\">" + svg::without_links(figure.svg) + "<figcaption>" +
           escape_html(figure.caption) + "</figcaption></figure>";
  return out + "</div>";
}

std::string html(const Picture& picture) {
  if (shape_of_picture(picture.png) <= 0) return "";
  const auto* bytes = reinterpret_cast<const unsigned char*>(picture.png.data());
  return "<figure style=\"width:" + percent(picture.share) + "\"><img alt=\"\" src=\"data:image/png;base64," +
         base64({bytes, picture.png.size()}) + "\"/><figcaption>" + escape_html(picture.caption) +
         "</figcaption></figure>";
}

std::string html(const Verdict& verdict) {
  return std::string("<section class=\"verdict ") + class_of(verdict.tone) + "\"><p class=\"word\">" +
         escape_html(verdict.word) + "</p><p class=\"reason\">" + escape_html(verdict.reason) +
         "</p><p class=\"number\">" + escape_html(verdict.number) + "<small>" + escape_html(verdict.under_number) +
         "</small></p></section>";
}

}  // namespace

std::string html_of(const Report& report) {
  std::string out = html_begin(report.kind + ": " + report.who);
  if (!report.mark.empty())
    out += "<p class=\"ribbon\"><strong>" + escape_html(report.mark) +
           "</strong>: these trainees and attempts are invented. Nothing here is a record.</p>";
  out += "<p class=\"quiet\">" + escape_html(report.kind) +
         (report.newest_utc.empty() ? "" : ", record to " + escape_html(day_text(report.newest_utc))) + "</p><h1>" +
         escape_html(report.title) + "</h1><p class=\"quiet\">" + escape_html(report.subtitle) + "</p>";
  for (const Block& block : report.blocks) out += std::visit([](const auto& one) { return html(one); }, block) + "\n";
  return out +
         "<footer>Trocar is a training aid, not a medical device. A score judges a run at a simulator; a person "
         "signs.</footer>" +
         html_end();
}

}  // namespace trocar::printed
