#include "trainees/desk/pages/page_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "trainees/desk/server/path_redaction.h"
#include "trainees/desk/words/page_language.h"
#include "trainees/markup/html.h"
#include "trainees/markup/svg.h"

namespace trocar::review {
namespace {

/// Shapes that differ in outline, so that they are told apart without colour; 12 by 12.
struct Shape {
  const char *name, *path;
};
constexpr std::array<Shape, 14> kShapes = {{
    {"unsafe", "M6 0.5 11.8 11.5H0.2Z"},
    {"relapsed", "M1 2h3v5h3V3.5L11.5 7 7 11.5V9H1Z"},
    {"in-question", "M6 0 12 6 6 12 0 6ZM5.2 2.8h1.6v4H5.2ZM5.2 7.8h1.6v1.6H5.2Z"},
    {"stuck", "M1 1h10v10H1Z"},
    {"plateau", "M0 4.2h12v3.6H0Z"},
    {"integrity", "M6 0 12 6 6 12 0 6Z"},
    {"retention-due", "M6 0a6 6 0 1 0 0.01 0ZM5.1 2h1.8v3.6l2.6 1.5-.9 1.6-3.5-2.1Z"},
    {"ready", "M0.5 6.5 2.5 4.4 4.7 6.6 9.6 1.4 11.6 3.4 4.7 10.7Z"},
    {"certified", "M1 0h10v7L6 12 1 7ZM3 4.9 5.3 7.2 9.2 3.3 8.2 2.3 5.3 5.2 4 3.9Z"},
    {"learning", "M6 1a5 5 0 1 0 0.01 0ZM6 3a3 3 0 1 1-0.01 0Z"},
    {"not-started", "M1 5h2.4v2H1ZM4.8 5h2.4v2H4.8ZM8.6 5H11v2H8.6Z"},
    {"pass", "M0.5 6.5 2.5 4.4 4.7 6.6 9.6 1.4 11.6 3.4 4.7 10.7Z"},
    {"fail", "M2.2 0.6 6 4.4 9.8 0.6 11.4 2.2 7.6 6 11.4 9.8 9.8 11.4 6 7.6 2.2 11.4 0.6 9.8 4.4 6 0.6 2.2Z"},
    {"void", "M6 0a6 6 0 1 0 0.01 0ZM2.5 5h7v2h-7Z"},
}};

std::string sprite() {
  std::string out = "<svg class=\"sprite\" width=\"0\" height=\"0\" aria-hidden=\"true\">";
  for (const Shape& s : kShapes)
    out += std::string("<symbol id=\"s-") + s.name + "\" viewBox=\"0 0 12 12\"><path fill-rule=\"evenodd\" d=\"" +
           s.path + "\"/></symbol>";
  return out + "</svg>";
}

std::string nav(const Frame& frame) {
  std::string out = "<nav aria-label=\"Pages\">";
  if (!frame.own_code.empty())
    out += link_html("/trainee/" + url_part(frame.own_code), "My page");
  else
    out += link_html("/", "Cohort") + link_html("/why", "Why") + link_html("/roster", "Roster") +
           link_html("/programmes", "Programmes") + link_html("/curriculum", "Curriculum") +
           link_html("/station", "Station");
  if (frame.administrator) out += link_html("/accounts", "Accounts") + link_html("/record", "Record");
  return out + "</nav>";
}

std::string top(const Frame& frame) {
  std::string out = "<header class=\"top\"><span class=\"brand\">Trocar desk</span>" + (frame.ended ? "" : nav(frame));
  if (!frame.who.empty() && frame.signed_in)
    out += "<form class=\"who\" method=\"post\" action=\"/sign-out\"><input type=\"hidden\" name=\"token\" value=\"" +
           escape_html(frame.token) + "\"/>" + verbatim(frame.who) + link_html("/password", "Password") +
           "<button>Sign out</button></form>";
  else if (!frame.who.empty())
    out += "<p class=\"who\">" + who_html(frame) + "</p>";
  out += "</header>";
  if (!frame.demo) return out;
  out +=
      "<div class=\"ribbon\" role=\"note\"><p><strong>Demo.</strong> These trainees and attempts are invented. Nothing "
      "here is a record.</p>";
  if (frame.demo_goes) out += "<a class=\"button\" href=\"/demo/remove\">Remove the demo</a>";
  return out + "</div>";
}

/// What only paper shows: whose page it is and when it was made.
std::string paper_line(const Frame& frame) {
  return "<p class=\"paper\">Trocar desk: " +
         (frame.title_verbatim ? verbatim(frame.title) : escape_html(frame.title)) +
         (frame.now_utc.empty() ? "" : ". Printed from the page of " + date_html(frame.now_utc) + " UTC") +
         (frame.who.empty() ? "" : ", " + who_html(frame)) + "</p>";
}

constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                 "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

/// "22 Nov 2026", "" when the text does not begin with a date.
std::string day_of(const std::string& utc) {
  if (utc.size() < 10 || utc[4] != '-' || utc[7] != '-') return "";
  for (const std::size_t i : {0U, 1U, 2U, 3U, 5U, 6U, 8U, 9U})
    if (utc[i] < '0' || utc[i] > '9') return "";
  const int month = std::atoi(utc.substr(5, 2).c_str()), day = std::atoi(utc.substr(8, 2).c_str());
  if (month < 1 || month > 12) return "";
  return std::to_string(day) + " " + kMonths.at(static_cast<std::size_t>(month - 1)) + " " + utc.substr(0, 4);
}

bool begins_with_file(const std::string& text) {
  const std::size_t dot = text.find('.'), end = std::min(text.find_first_of(" :"), text.size());
  return dot < end && dot + 1 < end;
}

std::string label_for(const std::string& id, const std::string& words) {
  return "<label for=\"" + id + "\">" + escape_html(words) + "</label>";
}

}  // namespace

namespace {
/// "13:05:09", with the day before it when that is not today's.
std::string clock_html(const std::string& utc, const std::string& now_utc) {
  const std::string clock = utc.size() >= 19 ? utc.substr(11, 8) : utc;
  const std::string day = utc.substr(0, 10) == now_utc.substr(0, 10) ? "" : day_of(utc) + ", ";
  return "<time datetime=\"" + escape_html(utc) + "\">" + escape_html(day + clock) + "</time> UTC";
}

/// What a reader must know before relying on the page.
std::string central_banner(const ReplicaStatus& central, const std::string& now_utc) {
  if (central.host.empty() || (central.lost_since_utc.empty() && central.waiting == 0)) return "";
  std::string out = "<p class=\"central\" role=\"status\">";
  if (!central.lost_since_utc.empty()) {
    out += "<strong>The centre " + escape_html(central.host) + " cannot be reached</strong> since " +
           clock_html(central.lost_since_utc, now_utc) + ". What you see is as of " +
           clock_html(central.as_of_utc, now_utc) + ".";
  }
  if (central.waiting > 0) {
    out += (central.lost_since_utc.empty() ? "" : " ") + plural(central.waiting, "thing", "things") +
           " written at this desk " + (central.waiting == 1 ? "is" : "are") + " kept here and not at the centre yet.";
  }
  return out + "</p>";
}

std::string central_footer(const ReplicaStatus& central, const std::string& now_utc) {
  if (central.host.empty()) return "";
  return " Central record as of " + clock_html(central.as_of_utc, now_utc) + " from " + escape_html(central.host) + ".";
}
}  // namespace

std::string document(const Frame& frame, const std::string& main_html) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>";
  // With script the page renews its parts instead (desk.js).
  if (frame.refresh_s > 0)
    out += "<noscript><meta http-equiv=\"refresh\" content=\"" + std::to_string(frame.refresh_s) + "\"/></noscript>";
  out += std::string(frame.title_verbatim ? "<title translate=\"no\">" : "<title>") + escape_html(frame.title) +
         " - Trocar desk</title><link rel=\"icon\" href=\"/icon.svg\"/><link rel=\"stylesheet\" href=\"/style.css\"/>"
         "<script src=\"/desk.js\" defer=\"defer\"></script></head><body>"
         "<a class=\"skip\" href=\"#main\">Skip to the content</a>";
  out +=
      sprite() + top(frame) + paper_line(frame) + "<main id=\"main\">" + central_banner(frame.central, frame.now_utc);
  if (!frame.lost_key.empty())
    out += "<p class=\"warning\" role=\"status\">" + shape("integrity") +
           "This record takes no decisions now: " + escape_html(frame.lost_key) + ".</p>";
  if (!frame.notice.empty()) out += "<p class=\"notice\" role=\"status\">" + escape_html(frame.notice) + "</p>";
  out += main_html +
         "</main><footer><p>Trocar is a training aid, not a medical device. A score judges a run at a simulator; a "
         "person signs.";
  if (!frame.now_utc.empty()) out += " Page made " + date_html(frame.now_utc) + " UTC.";
  out += central_footer(frame.central, frame.now_utc);
  return out + "</p>" + language_links(frame.query) + "</footer></body></html>\n";
}

std::string kept(const Frame& frame, const std::string& form, const std::string& field, const std::string& otherwise) {
  if (frame.refused.form != form) return otherwise;
  const auto it = frame.refused.values.find(field);
  return it == frame.refused.values.end() ? otherwise : it->second;
}

std::string why_refused(const Frame& frame, const std::string& form) {
  if (frame.refused.form != form) return "";
  return "<p class=\"error\" role=\"alert\" id=\"why-" + escape_html(form) + "\">" + shape("fail") + "Not done. " +
         escape_html(sentence(frame.refused.why)) + "</p>";
}

std::string unread_rules_notice(const std::string& why) {
  if (why.empty()) return "";
  return "<p class=\"warning\">" + shape("integrity") +
         "Newer rules are kept here and do not rule: " + escape_html(why) +
         ". Those before them are in force until newer ones are saved.</p>";
}

std::string refused_field(const Frame& frame, const std::string& form) {
  if (frame.refused.form != form) return "";
  return " aria-invalid=\"true\" autofocus=\"autofocus\" aria-describedby=\"why-" + escape_html(form) + "\"";
}

std::string sentence(const std::string& message) {
  std::string out = without_folders(message);
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z' && !begins_with_file(out)) out[0] = static_cast<char>(out[0] - 32);
  if (!out.empty() && std::string(".!?").find(out.back()) == std::string::npos) out += '.';
  return out;
}

std::string url_part(const std::string& text) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '.' || c == '_' || c == '~';
    if (plain)
      out += c;
    else
      out += std::string("%") + kDigits[byte >> 4] + kDigits[byte & 15U];
  }
  return out;
}

std::string query_html(const std::vector<std::pair<std::string, std::string>>& items) {
  std::string out = "?";
  for (const auto& [name, value] : items)
    if (!value.empty()) out += (out.size() > 1 ? "&amp;" : "") + url_part(name) + "=" + url_part(value);
  return out;
}

std::string link_html(const std::string& href_html, const std::string& words) {
  return "<a href=\"" + href_html + "\">" + escape_html(words) + "</a>";
}

std::string verbatim_link(const std::string& href_html, const std::string& words) {
  return "<a translate=\"no\" href=\"" + href_html + "\">" + escape_html(words) + "</a>";
}

std::string verbatim(const std::string& words) { return "<span translate=\"no\">" + escape_html(words) + "</span>"; }
std::string verbatim_cell(const std::string& words) { return "<td translate=\"no\">" + escape_html(words) + "</td>"; }

std::string language_links(const std::map<std::string, std::string>& query) {
  std::string out = "<p class=\"languages\" translate=\"no\">";
  for (const DeskTongue& one : kDeskTongues) {
    std::vector<std::pair<std::string, std::string>> items(query.begin(), query.end());
    items.emplace_back("lang", one.code);
    out += std::string("<a lang=\"") + one.code + "\" hreflang=\"" + one.code + "\" href=\"" + query_html(items) +
           "\">" + one.name + "</a> ";
  }
  return out + "</p>";
}

std::string shape(const std::string& name) {
  return "<svg class=\"shape\" viewBox=\"0 0 12 12\" aria-hidden=\"true\"><use href=\"#s-" + name + "\"/></svg>";
}

namespace {
struct FlagWords {
  Flag flag;
  const char *key, *words;
};
/// Gravest first.
constexpr std::array<FlagWords, 11> kFlags = {{{Flag::kUnsafe, "unsafe", "unsafe"},
                                               {Flag::kRelapsed, "relapsed", "relapsed"},
                                               {Flag::kInQuestion, "in-question", "in question"},
                                               {Flag::kStuck, "stuck", "stuck"},
                                               {Flag::kIntegrity, "integrity", "check record"},
                                               {Flag::kPlateau, "plateau", "plateau"},
                                               {Flag::kRetentionDue, "retention-due", "retention due"},
                                               {Flag::kReady, "ready", "ready"},
                                               {Flag::kCertified, "certified", "certified"},
                                               {Flag::kLearning, "learning", "learning"},
                                               {Flag::kNotStarted, "not-started", "not started"}}};
}  // namespace

int gravity(Flag flag) {
  for (std::size_t i = 0; i < kFlags.size(); ++i)
    if (kFlags.at(i).flag == flag) return static_cast<int>(i);
  return static_cast<int>(kFlags.size());
}

Flag state_named(const std::string& name, Flag otherwise) {
  for (const FlagWords& f : kFlags)
    if (name == f.key) return f.flag;
  return otherwise;
}

namespace {
const FlagWords& words_for(Flag flag) {
  return kFlags.at(static_cast<std::size_t>(std::min(gravity(flag), static_cast<int>(kFlags.size()) - 1)));
}
}  // namespace

std::string flag_words(Flag flag) { return words_for(flag).words; }

std::string badge(Flag flag) {
  const FlagWords& f = words_for(flag);
  return std::string("<span class=\"badge ") + f.key + "\">" + shape(f.key) + f.words + "</span>";
}

std::string day_html(const std::string& utc) {
  const std::string day = day_of(utc);
  return day.empty() ? escape_html(utc) : "<time datetime=\"" + escape_html(utc) + "\">" + day + "</time>";
}

std::string date_html(const std::string& utc) {
  const std::string day = day_of(utc);
  if (day.empty()) return escape_html(utc);
  const std::string clock = utc.size() >= 16 ? ", " + utc.substr(11, 5) : "";
  return "<time datetime=\"" + escape_html(utc) + "\">" + day + escape_html(clock) + "</time>";
}

std::string score_text(const std::optional<double>& score) { return score ? fixed_text(*score, 1) : "\xE2\x80\x93"; }

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e9) return "n/a";
  const long whole = std::lround(seconds);
  const std::string rest = std::to_string(whole % 60);
  return std::to_string(whole / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

std::string plural(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string reliability_text(const std::optional<double>& reliability) {
  return reliability ? reliability_words(*reliability) : "not known yet";
}

std::string basis_text(const Judgement& judgement) {
  return "n = " + std::to_string(judgement.n) +
         (judgement.decided > 0 ? ", " + std::to_string(judgement.decided) + " by decision" : "") + ", reliability " +
         reliability_text(judgement.reliability) + ", rules " + judgement.rule_version;
}

std::string basis_html(const Judgement& judgement) {
  return "<small class=\"dim\">" + escape_html(basis_text(judgement)) + "</small>";
}

std::string form_begin(const std::string& action_html, const Frame& frame) {
  return "<form method=\"post\" action=\"" + action_html + "\"><input type=\"hidden\" name=\"token\" value=\"" +
         escape_html(frame.token) + "\"/>";
}

std::string text_field(const std::string& id, const std::string& name, const std::string& label,
                       const std::string& value, const std::string& extra_html) {
  return "<p class=\"field\">" + label_for(id, label) + "<input id=\"" + id + "\" name=\"" + name + "\" value=\"" +
         escape_html(value) + "\" " + extra_html + "/></p>";
}

std::string password_field(const std::string& id, const Frame& frame) {
  if (!frame.signed_in) return "";
  return text_field(id, "password", "Your password again", "",
                    "type=\"password\" maxlength=\"1024\" required=\"required\" autocomplete=\"current-password\"");
}

std::string author_text(const std::string& printed, const std::string& account_uuid, bool demo) {
  if (!account_uuid.empty()) return printed;
  return printed + (demo ? " (of the demo)" : " (no account)");
}

std::string who_html(const Frame& frame) { return frame.signed_in ? verbatim(frame.who) : printed_html(frame.who); }

std::string author_html(const std::string& printed, const std::string& account_uuid, bool demo) {
  return printed_html(printed, account_uuid) + author_text("", account_uuid, demo);
}

std::string printed_html(const std::string& printed, const std::optional<std::string>& account_uuid) {
  const bool nobodys = account_uuid && account_uuid->empty();
  const bool own = printed == "Local instructor" ? nobodys || !account_uuid : printed == "Demo" && nobodys;
  return own ? "<span>" + escape_html(printed) + "</span>" : verbatim(printed);
}

std::string area_field(const std::string& id, const std::string& name, const std::string& label,
                       const std::string& value, int rows, const std::string& extra_html) {
  return "<p class=\"field\">" + label_for(id, label) + "<textarea id=\"" + id + "\" name=\"" + name + "\" rows=\"" +
         std::to_string(rows) + "\" " + extra_html + ">\n" + escape_html(value) + "</textarea></p>";
}

std::string select_field(const std::string& id, const std::string& name, const std::string& label,
                         const std::vector<std::pair<std::string, std::string>>& choices, const std::string& chosen,
                         bool choices_verbatim) {
  std::string out = "<p class=\"field\">" + label_for(id, label) + "<select id=\"" + id + "\" name=\"" + name + "\">";
  for (const auto& [value, words] : choices)
    out += "<option value=\"" + escape_html(value) + "\"" + (value == chosen ? " selected=\"selected\"" : "") +
           (choices_verbatim && !value.empty() ? " translate=\"no\">" : ">") + escape_html(words) + "</option>";
  return out + "</select></p>";
}

std::string fact(const std::string& name, const std::string& words, bool mono) {
  return "<div><dt>" + escape_html(name) + "</dt><dd" + (mono ? " class=\"mono\"" : "") + ">" + escape_html(words) +
         "</dd></div>";
}

std::string section(const std::string& id, const std::string& title, const std::string& inner_html,
                    const std::string& classes) {
  return "<section id=\"" + id + "\" class=\"" + classes + "\" aria-labelledby=\"" + id + "-h\"><h2 id=\"" + id +
         "-h\">" + escape_html(title) + "</h2>" + inner_html + "</section>";
}

std::string figure(const std::string& svg_html, const std::string& caption_html) {
  return "<figure><div class=\"plot\">" + svg_html + "</div>" +
         (caption_html.empty() ? "" : "<figcaption>" + caption_html + "</figcaption>") + "</figure>";
}

std::string table(const std::string& caption, const std::string& head_html, const std::string& rows_html,
                  const std::string& classes) {
  return "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + escape_html(caption) + "\"><table" +
         (classes.empty() ? "" : " class=\"" + classes + "\"") + "><caption>" + escape_html(caption) +
         "</caption><thead><tr>" + head_html + "</tr></thead><tbody>" + rows_html + "</tbody></table></div>";
}

namespace {
/// Rows whose data cells say the column that they stand in; one over several columns says none.
std::string labelled(const std::string& rows_html, const std::vector<std::string>& head) {
  std::string out;
  std::size_t column = 0, from = 0;
  for (std::size_t at = 0; (at = rows_html.find("<t", at)) != std::string::npos; ++at) {
    const std::string_view tag = std::string_view(rows_html).substr(at, 4);
    if (tag == "<tr>" || tag == "<tr ") column = 0;
    const bool data = tag == "<td>" || tag == "<td ";
    if (!data && tag != "<th>" && tag != "<th ") continue;
    const std::string label = column < head.size() ? head[column].substr(head[column].starts_with('>') ? 1 : 0) : "";
    ++column;
    const bool spans = rows_html.substr(at, rows_html.find('>', at) - at).find("colspan") != std::string::npos;
    if (!data || spans || label.empty()) continue;
    out += rows_html.substr(from, at + 3 - from) + " data-label=\"" + escape_html(label) + "\"";
    from = at + 3;
  }
  return out + rows_html.substr(from);
}
}  // namespace

std::string stacked_table(const std::string& caption, const std::vector<std::string>& head,
                          const std::string& rows_html, const std::string& classes) {
  return table(caption, head_cells(head), labelled(rows_html, head),
               classes.empty() ? "stacked" : "stacked " + classes);
}

std::string head_cells(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    const bool number = !word.empty() && word[0] == '>';
    out += std::string("<th scope=\"col\"") + (number ? " class=\"n\"" : "") + ">" +
           escape_html(number ? word.substr(1) : word) + "</th>";
  }
  return out;
}

std::string cell(const std::string& words) { return "<td>" + escape_html(words) + "</td>"; }
std::string number_cell(const std::string& words) { return "<td class=\"n\">" + escape_html(words) + "</td>"; }

std::vector<std::pair<std::string, std::string>> one_of(const std::vector<std::string>& values) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& value : values) out.emplace_back(value, value);
  return out;
}

std::vector<std::pair<std::string, std::string>> all_or_one(const std::string& all,
                                                            const std::vector<std::string>& values) {
  auto out = one_of(values);
  out.emplace(out.begin(), "", all);
  return out;
}

std::string part_links(const std::string& label, int page, int pages,
                       const std::function<std::string(int n)>& href_html) {
  if (pages <= 1) return "";
  std::string out = "<nav class=\"pages\" aria-label=\"" + escape_html(label) + "\">";
  for (int n = 1; n <= pages; ++n) {
    if (n != 1 && n != pages && std::abs(n - page) > 2) {
      if (std::abs(n - page) == 3) out += "<span>\xE2\x80\xA6</span>";
      continue;
    }
    out += n == page ? "<strong aria-current=\"page\">" + std::to_string(n) + "</strong>"
                     : link_html(href_html(n), std::to_string(n));
  }
  return out + "</nav>";
}

}  // namespace trocar::review
