#include "trainees/desk/queries/roster_views.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

constexpr const char* kExample = "code;name;email;group\nA-17;Ada Lovelace;ada@example.org;2026 A";

const char* fate_shape(RowFate fate) {
  switch (fate) {
    case RowFate::kNew:
    case RowFate::kJoins:
      return "pass";
    case RowFate::kThere:
      return "void";
    case RowFate::kRefused:
      return "fail";
  }
  return "void";
}

std::string import_row(const ImportRow& row) {
  return std::string("<tr") + (row.fate == RowFate::kRefused ? " class=\"grave\"" : "") + ">" +
         number_cell(std::to_string(row.line)) + "<td class=\"long\">" + shape(fate_shape(row.fate)) +
         fate_words(row.fate) +
         (row.reason.empty() ? "" : "<br/><small>" + escape_html(sentence(row.reason)) + "</small>") +
         "</td><th scope=\"row\" translate=\"no\">" + escape_html(row.code) + "</th>" + verbatim_cell(row.name) +
         "<td class=\"long\" translate=\"no\">" + escape_html(row.email) + "</td>" + verbatim_cell(row.group) + "</tr>";
}

std::string import_table(const ImportPreview& preview, bool done) {
  std::string rows, counts;
  for (const RowFate fate : {RowFate::kRefused, RowFate::kNew, RowFate::kJoins, RowFate::kThere})
    for (const ImportRow& row : preview.rows)
      if (row.fate == fate) rows += import_row(row);
  for (const auto& [fate, words] : {std::pair{RowFate::kNew, "added"},
                                    {RowFate::kJoins, "there already, joining the group"},
                                    {RowFate::kThere, "there already and skipped"},
                                    {RowFate::kRefused, "refused"}})
    if (const int n = preview.count(fate); n > 0)
      counts += (counts.empty() ? "" : ", ") + std::to_string(n) + " " + words;
  std::string remarks;
  for (const std::string& remark : preview.remarks)
    remarks += "<p class=\"warning\">" + shape("integrity") + escape_html(sentence(remark)) + "</p>";
  return remarks + "<p class=\"live\"><strong>" + counts + ".</strong> " +
         (done ? "Done." : "Nothing is written yet.") + "</p>" +
         stacked_table(done ? "What was done, refused lines first" : "What would be done, refused lines first",
                       {">Line", "What", "Code", "Name", "E-mail", "Group"}, rows);
}

/// After an import: cards of those who are new.
std::string after_import(const ImportView& view, const Frame& frame) {
  std::string people;
  for (const ImportRow& row : view.preview->rows)
    if (row.fate == RowFate::kNew)
      people += "<input type=\"hidden\" name=\"p:" + escape_html(row.code) + "\" value=\"yes\"/>";
  if (people.empty()) return "<p>" + link_html("/roster", "To the roster") + "</p>";
  return form_begin("/roster/selected", frame) + people +
         "<p class=\"buttons\"><button name=\"do\" value=\"cards\">Sign-in cards of the new ones</button> " +
         (view.pins ? "<button formaction=\"/roster/pins\">PINs for them, and cards that show them</button> " : "") +
         "<a class=\"button\" href=\"/roster" + query_html({{"group", view.group}}) + "\">To the roster</a></p></form>";
}

std::string import_form(const ImportView& view, const Frame& frame) {
  std::string out =
      form_begin("/roster/import", frame) +
      "<p class=\"field\" hidden=\"hidden\" data-reads=\"i-csv\"><label for=\"i-file\">File that a "
      "spreadsheet saved as CSV</label><input type=\"file\" id=\"i-file\" accept=\".csv,.txt,text/csv\"/> "
      "<output for=\"i-file\"></output></p>" +
      area_field("i-csv", "csv", "The list: first line the names of the columns", view.csv, 8,
                 "class=\"code\" required=\"required\" spellcheck=\"false\" placeholder=\"" + escape_html(kExample) +
                     "\"" + (view.problem.empty() ? "" : " aria-invalid=\"true\" autofocus=\"autofocus\"")) +
      "<div class=\"fields\">" +
      text_field("i-group", "group", "Group of those who name none", view.group,
                 "maxlength=\"64\" autocomplete=\"off\"") +
      "</div>";
  if (!view.problem.empty())
    out += "<p class=\"error\" role=\"alert\">" + shape("fail") + escape_html(sentence(view.problem)) + "</p>";
  const bool shown = view.preview && view.preview->count(RowFate::kNew) + view.preview->count(RowFate::kJoins) > 0;
  out += "<p class=\"buttons\"><button name=\"do\" value=\"look\"" +
         std::string(shown ? " class=\"quiet-button\"" : "") + ">Look at it first</button>";
  if (shown)
    out += " <button name=\"do\" value=\"take\">Add " + plural(view.preview->count(RowFate::kNew), "person", "people") +
           (view.preview->count(RowFate::kJoins) > 0
                ? ", " + std::to_string(view.preview->count(RowFate::kJoins)) + " into their group"
                : std::string()) +
           "</button>";
  return out + "</p></form>";
}

}  // namespace

std::string import_page(const ImportView& view, Frame frame) {
  frame.title = "Add a list";
  const std::string words =
      "<p>A column <strong>code</strong> is needed; <strong>name</strong> (or first name and last name), "
      "<strong>e-mail</strong> and <strong>group</strong> may be there, others are passed over. Commas, semicolons and "
      "tabs all do. Nothing is written before you have seen what would be.</p>";
  std::string main = "<div class=\"title\"><h1>Add a list of people</h1><p class=\"files\">" +
                     link_html("/roster", "Roster") + "</p></div>";
  if (view.done && view.preview)
    return document(frame,
                    main + section("done", "Done", after_import(view, frame) + import_table(*view.preview, true)));
  main += section("list", "The list", words + import_form(view, frame));
  if (view.preview) main += section("preview", "What would be done", import_table(*view.preview, false));
  return document(frame, main);
}

std::string cards_page(const std::vector<SignInCard>& cards, Frame frame) {
  frame.title = "Sign-in cards";
  std::string out;
  bool pins = false;
  for (const SignInCard& card : cards) {
    pins = pins || !card.pin.empty();
    std::string groups;
    for (const std::string& group : card.groups) groups += (groups.empty() ? "" : ", ") + group;
    out += "<li><p class=\"name\">" + verbatim(card.name.empty() ? card.code : card.name) +
           "</p><p>Code <strong class=\"key-in\" translate=\"no\">" + escape_html(card.code) + "</strong></p>" +
           (card.pin.empty() ? "" : "<p>PIN <strong class=\"key-in\">" + escape_html(card.pin) + "</strong></p>") +
           (card.problem.empty() ? "" : "<p class=\"bad\">" + escape_html(sentence(card.problem)) + "</p>") +
           "<p class=\"dim\">" + (groups.empty() ? "" : verbatim(groups) + ". ") +
           (card.pin.empty() ? "Type the code at the station."
                             : "Type the code at the station, then the PIN; the same PIN opens the desk (login " +
                                   escape_html(card.login) + "). Change it there.") +
           "</p></li>";
  }
  return document(
      frame, "<div class=\"title\"><h1>Sign-in cards</h1><p class=\"dim\">" +
                 plural(static_cast<std::int64_t>(cards.size()), "card", "cards") + "</p><p class=\"files\">" +
                 link_html("/roster", "Roster") + "</p></div><p class=\"warning\">" + shape("integrity") +
                 (pins ? "These PINs are shown this once. Print the page now (Ctrl-P): they are kept as hashes, and "
                         "nobody can read them back."
                       : "Print the page (Ctrl-P). These cards carry no PIN: PINs are kept as hashes and cannot be "
                         "read back; a card shows one only on the page that gave it.") +
                 "</p><ul class=\"cards\">" + out + "</ul>");
}

}  // namespace trocar::review
