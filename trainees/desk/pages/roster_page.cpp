#include <algorithm>

#include "trainees/desk/queries/roster_views.h"
#include "trainees/desk/queries/views.h"
#include "trainees/markup/html.h"

namespace trocar::review {
namespace {

std::string shown_person(const RosterEntry& one) { return one.name.empty() ? one.code : one.name; }

std::string roster_filters(const RosterView& view) {
  return "<form class=\"filters\" method=\"get\" action=\"/roster\">" +
         select_field("f-group", "group", "Group", all_or_one("all groups", view.groups), view.group, true) +
         select_field("f-who", "who", "Who", {{"active", "active"}, {"deactivated", "deactivated"}, {"all", "both"}},
                      view.who) +
         "<p class=\"field\"><button>Show</button></p></form>";
}

std::string roster_row(const RosterEntry& one, int number) {
  const std::string id = "p-" + std::to_string(number), code = escape_html(one.code);
  std::string groups;
  for (const std::string& group : one.groups)
    groups += (groups.empty() ? "" : ", ") + verbatim_link("/roster" + query_html({{"group", group}}), group);
  return "<tr><td class=\"tick\"><input type=\"checkbox\" id=\"" + id + "\" name=\"p:" + code +
         "\" value=\"yes\"/><label class=\"unseen\" translate=\"no\" for=\"" + id + "\">" + code +
         "</label></td><th scope=\"row\">" + verbatim_link("/trainee/" + url_part(one.code), shown_person(one)) +
         (one.name.empty() ? "" : " <small class=\"dim\" translate=\"no\">" + code + "</small>") + "</th><td>" +
         groups + "</td>" + number_cell(std::to_string(one.attempts)) + "<td>" +
         (one.last_utc.empty() ? "<span class=\"dim\">never</span>" : day_html(one.last_utc)) + "</td><td>" +
         (one.login.empty() ? "<span class=\"dim\">none</span>" : verbatim(one.login)) + "</td><td>" +
         shape(one.active ? "pass" : "void") + (one.active ? "active" : "deactivated") + "</td><td>" +
         link_html("/roster/person" + query_html({{"code", one.code}}), "Change") + "</td></tr>";
}

std::string act_button(const char* what, const char* words, const char* classes = "") {
  return std::string("<button name=\"do\" value=\"") + what + "\"" +
         (*classes == '\0' ? "" : std::string(" class=\"") + classes + "\"") + ">" + words + "</button> ";
}

/// What is done to everybody who is ticked.
std::string roster_acts(const RosterView& view, const Frame& frame) {
  std::string out = "<fieldset class=\"acts\"><legend>With everybody who is ticked</legend><div class=\"fields\">" +
                    text_field("act-group", "group", "Group", kept(frame, "selected", "group", view.group),
                               "maxlength=\"64\" autocomplete=\"off\" list=\"groups\"") +
                    "<p class=\"field\">" + act_button("join", "Put into the group") +
                    act_button("leave", "Take out of it", "quiet-button") + "</p></div><datalist id=\"groups\">";
  for (const std::string& group : view.groups) out += "<option value=\"" + escape_html(group) + "\"></option>";
  out += "</datalist><div class=\"fields\">" +
         text_field("act-reason", "reason", "Reason (may stay empty)", kept(frame, "selected", "reason"),
                    "maxlength=\"200\" autocomplete=\"off\"") +
         "<p class=\"field\">" + act_button("deactivate", "Deactivate", "danger") +
         act_button("reactivate", "Reactivate", "quiet-button") + "</p></div><p class=\"buttons\">" +
         act_button("cards", "Sign-in cards to print", "quiet-button");
  if (view.pins)
    out += "<button formaction=\"/roster/pins\" class=\"quiet-button\">New PINs, and cards that show them</button>";
  return out + "</p><p class=\"dim\">Who is deactivated keeps the record and begins no attempt. " +
         (view.pins ? "A new PIN replaces the old one and is shown this once: it is kept as a hash, and nobody can "
                      "read it back."
                    : "Cards carry no PIN: PINs are kept as hashes, and a new one is given by an administrator who has "
                      "an account.") +
         "</p></fieldset>";
}

std::string roster_parts(const RosterView& view, int pages) {
  return part_links("Parts of the list", view.page, pages, [&view](int n) {
    return "/roster" + query_html({{"group", view.group}, {"who", view.who}, {"page", std::to_string(n)}});
  });
}

std::string roster_list(RosterView view, const Frame& frame) {
  const int count = static_cast<int>(view.people.size()),
            pages = std::max(1, (count + kPeopleOnPage - 1) / kPeopleOnPage);
  view.page = std::clamp(view.page, 1, pages);
  std::string rows;
  for (int i = (view.page - 1) * kPeopleOnPage; i < std::min(count, view.page * kPeopleOnPage); ++i)
    rows += roster_row(view.people[static_cast<std::size_t>(i)], i);
  if (rows.empty())
    return roster_filters(view) + (view.group.empty() && view.who == "active"
                                       ? "<p>Nobody yet: add a person below, or a whole list.</p>"
                                       : "<p>Nobody matches. Choose less above.</p>");
  const std::string head =
      "<th scope=\"col\" class=\"tick\"><span class=\"unseen\">Ticked</span><span hidden=\"hidden\" "
      "data-all=\"p:\"><input "
      "type=\"checkbox\" id=\"all\"/><label class=\"unseen\" for=\"all\">Everybody</label></span></th>" +
      head_cells({"Trainee", "Groups", ">Attempts", "Last seen", "Desk login", "State", ""});
  return roster_filters(view) +
         form_begin("/roster/selected" + query_html({{"group", view.group}, {"who", view.who}}), frame) +
         table(plural(count, "person", "people"), head, rows, "roster") + roster_parts(view, pages) +
         why_refused(frame, "selected") + roster_acts(view, frame) + "</form>";
}

std::string add_form(const RosterView& view, const Frame& frame) {
  return form_begin("/roster/add", frame) + "<div class=\"fields\">" +
         text_field("n-code", "code", "Code to sign in with", kept(frame, "add", "code"),
                    "maxlength=\"32\" required=\"required\" autocomplete=\"off\" autocapitalize=\"none\"" +
                        refused_field(frame, "add")) +
         text_field("n-name", "name", "Name", kept(frame, "add", "name"), "maxlength=\"100\" autocomplete=\"off\"") +
         text_field("n-email", "email", "E-mail", kept(frame, "add", "email"),
                    "maxlength=\"254\" autocomplete=\"off\"") +
         text_field("n-group", "group", "Group", kept(frame, "add", "group", view.group),
                    "maxlength=\"64\" autocomplete=\"off\"") +
         "</div>" + why_refused(frame, "add") + "<p class=\"buttons\"><button>Add</button> " +
         "<a class=\"button\" href=\"/roster/import\">Add a whole list (CSV)</a></p></form>";
}

}  // namespace

std::string roster_page(const RosterView& view, Frame frame) {
  frame.title = "Roster";
  const std::vector<std::pair<std::string, std::string>> asked = {{"group", view.group}, {"who", view.who}};
  return document(frame, "<div class=\"title\"><h1>Roster</h1><p class=\"dim\">" +
                             std::string(view.group.empty() ? "everybody" : "group " + verbatim(view.group)) +
                             (view.deactivated == 0 ? "" : ", " + std::to_string(view.deactivated) + " deactivated") +
                             "</p><p class=\"files\">" + link_html("/roster.csv" + query_html(asked), "CSV") +
                             "</p></div>" + section("people", "People", roster_list(view, frame)) +
                             section("add", "Add a person", add_form(view, frame)));
}

std::string person_page(const PersonView& view, Frame frame) {
  const RosterEntry& one = view.person;
  frame.title = shown_person(one);
  frame.title_verbatim = true;
  const std::string form = "person";
  /// What the form showed before anything was typed.
  const auto seen_field = [&](const char* name, const std::string& value) {
    return std::string("<input type=\"hidden\" name=\"") + name + "\" value=\"" +
           escape_html(kept(frame, form, name, value)) + "\"/>";
  };
  std::string groups;
  for (const std::string& group : one.groups) groups += (groups.empty() ? "" : ", ") + group;
  const Standing& standing = view.standing;
  const std::string told = standing.utc.empty()
                               ? ""
                               : "<p>" + std::string(standing.active ? "Reactivated " : "Deactivated ") +
                                     day_html(standing.utc) + " by " + printed_html(standing.printed) +
                                     (standing.reason.empty() ? "" : ": " + verbatim(standing.reason)) + ".</p>";
  return document(
      frame,
      "<div class=\"title\"><h1>" + verbatim(shown_person(one)) + "</h1><p class=\"dim\">" + verbatim(one.code) +
          (groups.empty() ? "" : ", " + verbatim(groups)) + "</p><p class=\"files\">" +
          link_html("/trainee/" + url_part(one.code), "Attempts") + link_html("/roster", "Roster") + "</p></div>" +
          section("change", "Name and address",
                  form_begin("/roster/person" + query_html({{"code", one.code}}), frame) +
                      seen_field("seen_name", one.name) + seen_field("seen_email", one.email) +
                      "<div class=\"fields\">" +
                      text_field("c-name", "name", "Name", kept(frame, form, "name", one.name),
                                 "maxlength=\"100\" autocomplete=\"off\"" + refused_field(frame, form)) +
                      text_field("c-email", "email", "E-mail", kept(frame, form, "email", one.email),
                                 "maxlength=\"254\" autocomplete=\"off\"") +
                      "</div>" + why_refused(frame, form) +
                      "<p><button>Save</button></p></form><p class=\"dim\">The code stays: stations, recordings and "
                      "accounts know the person by it. An empty field takes the name or address away.</p>") +
          section(
              "state", "Taking part",
              told +
                  form_begin("/roster/selected" + query_html({{"who", one.active ? "active" : "deactivated"}}), frame) +
                  "<input type=\"hidden\" name=\"p:" + escape_html(one.code) + "\" value=\"yes\"/>" +
                  "<div class=\"fields\">" +
                  text_field("s-reason", "reason", "Reason (may stay empty)", "", "maxlength=\"200\"") + "</div><p>" +
                  (one.active ? act_button("deactivate", "Deactivate", "danger")
                              : act_button("reactivate", "Reactivate")) +
                  "</p></form><p class=\"dim\">Who is deactivated keeps the record, certificates and desk login, "
                  "begins no attempt, and is left out of cohort, grid and reminders.</p>"));
}

}  // namespace trocar::review
