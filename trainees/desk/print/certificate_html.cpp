#include "trainees/desk/print/html_file.h"
#include "trainees/desk/print/report.h"
#include "trainees/markup/html.h"

namespace trocar::printed {

std::string html_of(const CertificateSheet& sheet) {
  const auto p = [](const char* kind, const std::string& words) {
    return words.empty() ? "" : std::string("<p class=\"") + kind + "\">" + escape_html(words) + "</p>";
  };
  std::string out = html_begin(sheet.file_title()) + "<section class=\"sheet\">";
  if (!sheet.withdrawn.empty()) out += p("void", "WITHDRAWN " + sheet.withdrawn);
  if (!sheet.in_question.empty()) out += p("void", "IN QUESTION: " + sheet.in_question);
  if (sheet.demo) out += p("ribbon", "DEMO: an invented trainee. Nothing here is a record.");
  out += "<h1>Certificate of training</h1>" + p("quiet", "It is certified that") + p("holder", sheet.holder);
  if (sheet.code != sheet.holder) out += p("quiet", "trainee " + sheet.code);
  out += p("quiet", "has shown competence in") + p("skill", sheet.skill) + p("plain", sheet.statement) +
         "<dl class=\"facts\">";
  for (const auto& [name, value] : sheet.facts)
    out += "<div><dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd></div>";
  out += "</dl><table><caption>Evidence: " + escape_html(sheet.evidence_words) + "</caption>" +
         column_widths(sheet.columns) + "<thead><tr>";
  for (const Column& column : sheet.columns)
    out += std::string("<th scope=\"col\"") + (column.number ? " class=\"n\"" : "") + ">" + escape_html(column.title) +
           "</th>";
  out += "</tr></thead><tbody>";
  for (const auto& row : sheet.evidence) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size() && i < sheet.columns.size(); ++i)
      out += std::string("<td class=\"") +
             (sheet.columns[i].number ? "n"
              : sheet.columns[i].mono ? "mono"
                                      : "plain") +
             "\">" + escape_html(row[i]) + "</td>";
    out += "</tr>";
  }
  out += "</tbody></table><div class=\"not\"><h3>What it does not attest</h3>";
  for (const std::string& point : sheet.not_attested) out += p("point", point);
  out += "</div>" + p("signed", "Certified by " + sheet.certified_by + ", " + sheet.date + " (UTC)") +
         p("mono", "Certificate " + sheet.uuid) +
         p("quiet",
           "Trocar, a training aid and no medical device. This page prints a record and is not itself the record.");
  return out + "</section>" + html_end();
}

}  // namespace trocar::printed
