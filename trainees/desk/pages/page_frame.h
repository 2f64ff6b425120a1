// What all pages of the desk share: head, navigation, ribbon, footer; badges, dates, links, fields of forms.
//
// Functions return HTML; what they take is plain text unless its name ends in _html. Thread: any.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trainees/exchange/sync/replica_status.h"
#include "trainees/progress/judgement.h"

namespace trocar::review {

/// A form that was refused: its page comes back with what stood in it, and why beside the field.
struct RefusedForm {
  std::string form = {};  ///< "" when none was
  std::string why = {};
  std::map<std::string, std::string> values = {};
};

/// Around every page.
struct Frame {
  std::string title = {};
  bool title_verbatim = false;  ///< it is a name or has one in it
  std::string who = {};         ///< name of who looks; "" on pages before signing in
  bool signed_in = true;        ///< by an account, so that signing out means something
  std::string own_code = {};    ///< of a trainee: sees own pages only
  std::string token = {};       ///< goes into every form
  std::string now_utc = {};
  bool demo = false;
  bool may_write = true;  ///< instructors and administrators
  bool administrator = false;
  std::string no_signature = {};  ///< why who looks cannot sign now; "" when they can (signing.h)
  std::string lost_key = {};   ///< that the station's key is missing, for staff (station_key.h); "" while it is there
  bool demo_goes = false;      ///< the demo cohort can be removed from here
  bool ended = false;          ///< the desk closes: there is nowhere to go from this page
  bool pdf = false;            ///< PDF of this page can be had
  int refresh_s = 0;           ///< page asks for itself again
  std::string notice = {};     ///< what has just been done
  ReplicaStatus central = {};  ///< of a desk that serves a central record
  RefusedForm refused = {};
  std::map<std::string, std::string> query = {};  ///< of the page, kept when its language changes
};

/// What stood in that field of that form when it was refused, else `otherwise`.
std::string kept(const Frame& frame, const std::string& form, const std::string& field,
                 const std::string& otherwise = "");
/// Why that form was refused, for the place below its field; "" when it was not.
std::string why_refused(const Frame& frame, const std::string& form);
/// That newer rules of progress cannot be read; "" where `why` is.
std::string unread_rules_notice(const std::string& why);
/// Attributes that tie the field to that reason; "" when it was not refused.
std::string refused_field(const Frame& frame, const std::string& form);
/// A message of the program as a sentence: first letter large unless a file's name begins it, a stop at its end,
/// folders of the machine left out.
std::string sentence(const std::string& message);

/// Whole document. @param main_html what stands between header and footer.
std::string document(const Frame& frame, const std::string& main_html);

/// Part of a path or query: everything but letters, digits and -._~ as %XX.
std::string url_part(const std::string& text);
/// "?a=1&amp;b=2" for an attribute; empty values are left out; "?" when nothing is left.
std::string query_html(const std::vector<std::pair<std::string, std::string>>& items);
std::string link_html(const std::string& href_html, const std::string& words);
/// Words of people and of the record (a name, a code, a note): never translated, whatever they are.
std::string verbatim(const std::string& words);
std::string verbatim_cell(const std::string& words);
std::string verbatim_link(const std::string& href_html, const std::string& words);
/// Links at the foot of a page. @param query what its address asks for.
std::string language_links(const std::map<std::string, std::string>& query);

/// State as colour, shape and word.
std::string badge(Flag flag);
std::string flag_words(Flag flag);           ///< "check record": as the badge says it
std::string shape(const std::string& name);  ///< a small drawn shape: a flag's name, or pass, fail, void
Flag state_named(const std::string& name, Flag otherwise);
/// Gravest first: unsafe, relapsed, in question, stuck, integrity, plateau, retention due, ready, certified, learning,
/// not started.
int gravity(Flag flag);

/// "22 Nov 2026, 13:05" in a <time>; text that is no date stays as it is.
std::string date_html(const std::string& utc);
std::string day_html(const std::string& utc);
/// "86.5", or a dash for nothing.
std::string score_text(const std::optional<double>& score);
/// "1:05" of seconds; "0:12".
std::string clock_text(double seconds);
std::string plural(std::int64_t count, const std::string& one, const std::string& many);

/// What a decision rests on: "n = 16, 2 by decision, reliability 0.84, rules 1".
std::string basis_text(const Judgement& judgement);
std::string basis_html(const Judgement& judgement);  ///< small and dim
/// "0.84", or "not known yet".
std::string reliability_text(const std::optional<double>& reliability);

/// A text of the program with its days, "2026-11-30", as pages write them: "30 Nov 2026".
std::string dated(const std::string& text);

/// A link that names an attempt, by its UUID.
using AttemptNames = std::function<std::string(const std::string& uuid)>;
/// A certificate's evidence (JSON) in words, what it cites as links, digits folded away; text that is no JSON object
/// stays as it is.
std::string evidence_html(const std::string& json, const AttemptNames& named);

/// A form that posts, with the token. @param action_html already escaped.
std::string form_begin(const std::string& action_html, const Frame& frame);
std::string text_field(const std::string& id, const std::string& name, const std::string& label,
                       const std::string& value, const std::string& extra_html = "");
/// For a form that binds who sends it: their password once more; "" where nobody signs in.
std::string password_field(const std::string& id, const Frame& frame);
/// "Dr Brandt"; of a word that no account stands behind: "Demo (of the demo)", "Local instructor (no account)".
std::string author_text(const std::string& printed, const std::string& account_uuid, bool demo);
std::string author_html(const std::string& printed, const std::string& account_uuid, bool demo);
/// Who looks, by their name.
std::string who_html(const Frame& frame);
/// A name as it was printed. Those that the program gives who has no account are its own words and translated; a
/// person's never is. @param account_uuid nothing where it is not known
std::string printed_html(const std::string& printed, const std::optional<std::string>& account_uuid = {});
std::string area_field(const std::string& id, const std::string& name, const std::string& label,
                       const std::string& value, int rows, const std::string& extra_html = "");
std::string select_field(const std::string& id, const std::string& name, const std::string& label,
                         const std::vector<std::pair<std::string, std::string>>& choices, const std::string& chosen,
                         bool choices_verbatim = false);

/// One line of a list of facts (<dl class="facts">). @param mono the words are a hash or the like
std::string fact(const std::string& name, const std::string& words, bool mono = false);
/// <section> with a heading that names it.
std::string section(const std::string& id, const std::string& title, const std::string& inner_html,
                    const std::string& classes = "card");
/// <figure> that scrolls by itself where the screen is narrow.
std::string figure(const std::string& svg_html, const std::string& caption_html);
/// A table in a scroller of its own. @param head_html cells of the head.
std::string table(const std::string& caption, const std::string& head_html, const std::string& rows_html,
                  const std::string& classes = "");
/// A table whose rows become blocks on a narrow screen, where each cell says its column (data-label).
/// @param head as of head_cells()
std::string stacked_table(const std::string& caption, const std::vector<std::string>& head,
                          const std::string& rows_html, const std::string& classes = "");
std::string head_cells(const std::vector<std::string>& words);  ///< ">word" for a number's column
std::string cell(const std::string& words);
std::string number_cell(const std::string& words);

/// Choices of a filter that are called by what they send; before them what does not filter.
std::vector<std::pair<std::string, std::string>> one_of(const std::vector<std::string>& values);
std::vector<std::pair<std::string, std::string>> all_or_one(const std::string& all,
                                                            const std::vector<std::string>& values);
/// Links to the parts of a long list: first, last, and those beside the one that is shown; "" for one part.
/// @param href_html of the n-th, from 1.
std::string part_links(const std::string& label, int page, int pages,
                       const std::function<std::string(int n)>& href_html);

}  // namespace trocar::review
