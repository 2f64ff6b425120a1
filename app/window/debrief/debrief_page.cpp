#include "app/window/debrief/debrief_page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "app/window/ui/button_row.h"

namespace trocar {
namespace {

constexpr double kDebriefTwoColumns = 1000, kDebriefMargin = 20, kDebriefHead = 106, kNarrowPlots = 300,
                 kTableShare = 0.645;  // px at 720 lines and scale 1

Mark verdict_mark(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass:
      return Mark::kTick;
    case Outcome::kNotYet:
      return Mark::kHalf;
    case Outcome::kStopped:
      return Mark::kOpen;
    case Outcome::kDeviceStopped:
    case Outcome::kVoid:
      return Mark::kWarning;
  }
  return Mark::kOpen;
}

Mark row_mark(const DebriefRow& row) {
  if (row.failed) return Mark::kWarning;
  if (row.lost <= 0.1 * row.possible) return Mark::kTick;
  return row.lost <= 0.5 * row.possible ? Mark::kHalf : Mark::kOpen;
}

/// 0 to 100 with the pass line, by shape: filled from the left, the line a tick with its number.
void score_bar(Ui& ui, const DebriefFacts& facts, const Area& area) {
  const double bar = ui.px(14), y = area.y + ui.line_height() + ui.px(6),
               pass_x = area.x + area.width * facts.pass_at / 100;
  const Translator& w = ui.words();
  ui.text_at(area.x, area.y, w("{0} of 100 points", {w.number(*facts.score, 1)}), Ink::kText, area.width, 0, true);
  ui.paint_frame({area.x, y, area.width, bar}, Ink::kDim, 1, ui.px(3));
  const bool pass = facts.outcome == Outcome::kPass;
  ui.paint_box({area.x, y, area.width * *facts.score / 100, bar}, pass ? Ink::kGood : Ink::kCaution, 1, ui.px(3));
  ui.paint_line(pass_x, y - ui.px(4), pass_x, y + bar + ui.px(4), Ink::kText, 2);
  ui.text_at(pass_x, y + bar + ui.px(6), w("pass {0}", {w.number(facts.pass_at, 0)}), Ink::kDim, 0, 0.5);
}

/// A column of the table: its head, its cells, and whether it can be done without.
struct PageColumn {
  std::string head;
  std::vector<Ui::Cell> cells = {};
  int spare = 0;  ///< 0: always there; columns of the highest number go first
};

void add_column(std::vector<PageColumn>& all, const std::string& head, int spare, const std::vector<DebriefRow>& rows,
                const std::function<Ui::Cell(const DebriefRow&)>& cell) {
  PageColumn column{head, {}, spare};
  for (const DebriefRow& row : rows) column.cells.push_back(cell(row));
  const bool empty =
      std::all_of(column.cells.begin(), column.cells.end(), [](const Ui::Cell& c) { return c.text.empty(); });
  if (!empty) all.push_back(std::move(column));
}

std::vector<PageColumn> columns_of(const Translator& w, const std::vector<DebriefRow>& rows) {
  using Row = DebriefRow;
  const auto dim = [](const std::string Row::*text) {
    return [text](const Row& row) { return Ui::Cell{row.*text, Ink::kDim}; };
  };
  std::vector<PageColumn> all;
  std::optional<ScoreGroup> before;
  add_column(all, w("Part"), 1, rows, [&](const Row& row) {
    const bool first = before != row.group;
    before = row.group;
    return Ui::Cell{first ? group_name(w, row.group) : "", Ink::kDim};
  });
  add_column(all, w("Measured"), 0, rows, [](const Row& row) {
    return Ui::Cell{row.name, row.failed ? Ink::kAlarm : Ink::kText, row_mark(row)};
  });
  add_column(all, w("You"), 0, rows, [](const Row& row) { return Ui::Cell{row.value}; });
  add_column(all, w("All at"), 2, rows, dim(&Row::full));
  add_column(all, w("None at"), 2, rows, dim(&Row::none));
  add_column(all, w("Lost"), 0, rows, [&](const Row& row) {
    return Ui::Cell{w.number(row.lost, 1), row.lost >= 0.05 ? Ink::kText : Ink::kDim};
  });
  add_column(all, w("Best"), 4, rows, dim(&Row::best));
  add_column(all, w("Median"), 3, rows, [](const Row& row) {
    const Mark mark = row.against_median > 0 ? Mark::kUp : row.against_median < 0 ? Mark::kDown : Mark::kNone;
    return Ui::Cell{row.median, Ink::kDim, mark};
  });
  add_column(all, w("Expert"), 5, rows, dim(&Row::expert));
  return all;
}

/// px that a column needs, air to the next included.
double need(const Ui& ui, const PageColumn& column) {
  double wide = ui.text_width(column.head);
  for (const Ui::Cell& cell : column.cells)
    wide = std::max(wide, ui.text_width(cell.text) + (cell.mark == Mark::kNone ? 0 : ui.line_height() + ui.px(8)));
  return wide + ui.px(11) + 1;
}

/// As many columns as fit; what is left out stands in the explanation.
std::vector<PageColumn> fitting(const Ui& ui, std::vector<PageColumn> all, double room) {
  const auto total = [&] {
    return std::accumulate(all.begin(), all.end(), ui.px(10),
                           [&](double sum, const PageColumn& c) { return sum + need(ui, c); });
  };
  for (int spare = 5; spare > 0 && total() > room; --spare)
    std::erase_if(all, [spare](const PageColumn& c) { return c.spare == spare; });
  return all;
}

/// What stands at the foot; the blue one first.
std::vector<RowButton> foot_buttons(const Translator& w, const DebriefContent& content,
                                    const std::optional<double>& cursor_s) {
  const bool onward = content.facts.outcome == Outcome::kPass;
  const std::string next = content.next_name.empty() ? w("Next") : w("Next: {0}", {content.next_name});
  std::vector<RowButton> out;
  if (onward) out.push_back({"next", next, "Enter", true});
  out.push_back({"retry", w("Try again"), onward ? "R" : "Enter", !onward});
  if (!onward) out.push_back({"next", next, "N"});
  if (content.can_watch) {
    const double from =
        content.plots.trace && cursor_s ? std::max(0.0, *cursor_s - content.plots.trace->begin_s - 3) : 0;
    out.push_back({"watch", w("Watch from {0} s", {w.number(from, 0)}), "W"});
  }
  if (content.can_compare) out.push_back({"compare", w("Compare with expert"), "S"});
  out.push_back({"progress", w("My progress"), "M"});
  if (content.guest)
    out.push_back({"signin", w("Sign in"), "I"});
  else
    out.push_back({"back", w("Back"), "Esc"});
  return out;
}

DebriefChoice meant(const std::string& id) {
  if (id == "next") return DebriefChoice::kNext;
  if (id == "retry") return DebriefChoice::kRetry;
  if (id == "watch") return DebriefChoice::kWatch;
  if (id == "compare") return DebriefChoice::kCompare;
  if (id == "progress") return DebriefChoice::kProgress;
  if (id == "back") return DebriefChoice::kBack;
  return id == "signin" ? DebriefChoice::kSignIn : DebriefChoice::kNone;
}

std::string foot_note(const Translator& w, const DebriefContent& content) {
  if (!content.compare_note.empty()) return content.compare_note;
  return content.guest ? w("Sign in to keep your runs under your own code; this one is kept as a guest's.") : "";
}

}  // namespace

void DebriefPage::verdict(Ui& ui, const DebriefContent& content) const {
  const DebriefFacts& facts = content.facts;
  const double all = ui.room(), side = ui.px(44), bar = facts.score && all >= ui.px(700) ? ui.px(250) : 0;
  const Area area = ui.drawing("verdict", bar > 0 ? 62 : 48);
  ui.paint_mark(verdict_mark(facts.outcome), area.x, area.y, side);
  const double x = area.x + side + ui.px(14);
  const double room = area.x + area.width - x - (bar > 0 ? bar + ui.px(24) : 0);
  ui.text_at(x, area.y - ui.px(2), facts.verdict, facts.outcome == Outcome::kPass ? Ink::kGood : Ink::kCaution, room, 0,
             true);
  ui.text_at(x, area.y + ui.px(25), content.heading, Ink::kDim, room);
  if (bar > 0) score_bar(ui, facts, {area.x + area.width - bar, area.y, bar, area.height});
}

void DebriefPage::rows(Ui& ui, const DebriefContent& content) {
  const Translator& w = ui.words();
  const DebriefFacts& facts = content.facts;
  for (const std::string& sentence : facts.more) ui.marked(Mark::kInfo, sentence, Ink::kText);
  if (facts.rows.empty()) return;
  const std::vector<PageColumn> shown = fitting(ui, columns_of(w, facts.rows), ui.room());
  std::vector<std::string> heads;
  std::vector<double> shares;
  std::vector<std::vector<Ui::Cell>> table(facts.rows.size());
  for (const PageColumn& column : shown) {
    heads.push_back(column.head);
    shares.push_back(need(ui, column));
    for (std::size_t r = 0; r < table.size(); ++r) table[r].push_back(column.cells[r]);
  }
  const int chosen = ui.table("rows", heads, shares, table);
  const int count = static_cast<int>(facts.rows.size());
  if (chosen >= 0)
    explained_ = explained_ == chosen ? -1 : chosen;
  else if (ui.pressed("E"))
    explained_ = explained_ + 1 >= count ? -1 : explained_ + 1;
  if (facts.lost_to_caps >= 0.05)
    ui.marked(
        Mark::kWarning,
        w("A cap took {0} more points: the score counts no higher while a safety rule is broken or the task undone.",
          {w.number(facts.lost_to_caps, 1)}),
        Ink::kCaution);
  ui.gap(2);
  if (explained_ >= 0) return explanation(ui, content);
  const bool arrows =
      std::any_of(facts.rows.begin(), facts.rows.end(), [](const DebriefRow& r) { return r.against_median != 0; });
  ui.text(w("[E] or a row: what a part means and how it is scored."), Ink::kDim);
  if (arrows) ui.text(w("Arrows: better or worse than your median."), Ink::kDim);
}

void DebriefPage::explanation(Ui& ui, const DebriefContent& content) {
  const auto row = static_cast<std::size_t>(explained_);
  ui.heading(content.facts.rows[row].name);
  const DebriefRow& shown = content.facts.rows[row];
  std::string text;
  for (const std::string& sentence : content.explained[row]) text += (text.empty() ? "" : " ") + sentence;
  if (!shown.median.empty())
    text += " " + ui.words()("Your best so far {0}, your median {1}.", {shown.best, shown.median});
  if (!shown.expert.empty()) text += " " + ui.words()("The expert hand on the same board: {0}.", {shown.expert});
  ui.text(text);
}

DebriefChoice DebriefPage::plots(Ui& ui, const DebriefContent& content, double height_at_720) {
  if (!content.plots.trace) {
    ui.text(content.plots_note, Ink::kDim);
    return DebriefChoice::kNone;
  }
  if (!cursor_set_) cursor_s_ = worst_moment(content.plots.events);
  cursor_set_ = true;
  const std::optional<double> clicked = draw_debrief_plots(ui, content.plots, cursor_s_, height_at_720);
  if (!clicked) return DebriefChoice::kNone;
  cursor_s_ = clicked;
  return content.can_watch ? DebriefChoice::kWatch : DebriefChoice::kNone;
}

DebriefChoice DebriefPage::foot(Ui& ui, const DebriefContent& content) {
  const DebriefChoice choice = meant(button_rows(ui, foot_buttons(ui.words(), content, cursor_s_)));
  const std::string note = foot_note(ui.words(), content);
  if (!note.empty()) ui.text(note, Ink::kDim);
  if (choice != DebriefChoice::kNone) return choice;
  if (ui.pressed("N")) return DebriefChoice::kNext;  // also when Enter stands on the button
  if (ui.pressed("R")) return DebriefChoice::kRetry;
  return ui.pressed("Esc") ? DebriefChoice::kBack : DebriefChoice::kNone;  // a guest's row is full
}

/// px that the foot needs; with the advice above its buttons where there are two columns.
double DebriefPage::foot_height(const Ui& ui, const DebriefContent& content, double wide, bool advised) const {
  const double room = ui.strip_room(wide), line = ui.px(7);
  const std::string note = foot_note(ui.words(), content);
  double high = button_rows_height(ui, foot_buttons(ui.words(), content, cursor_s_), wide);
  if (!note.empty()) high += ui.text_height(note, room) + line;
  if (advised) high += ui.text_height(content.advice, room - ui.line_height() - ui.px(10)) + line;
  return high;
}

DebriefChoice DebriefPage::draw(Ui& ui, const DebriefContent& content) {
  const double margin = std::min(ui.px(kDebriefMargin), 0.02 * ui.width()), gap = ui.px(8);
  const double wide = ui.width() - 2 * margin, high = ui.height() - 2 * margin;
  const bool two = wide >= ui.px(kDebriefTwoColumns);
  if (explained_ >= static_cast<int>(content.facts.rows.size())) explained_ = -1;
  const double foot_high = foot_height(ui, content, wide, two);
  const Area page{margin, margin, wide, high - foot_high - gap};
  const DebriefChoice chosen = two ? beside(ui, content, page) : below(ui, content, page);
  ui.begin_strip("debrief.foot", {margin, margin + high - foot_high, wide, foot_high});
  if (two) ui.marked(Mark::kInfo, content.advice, Ink::kHeading);
  const DebriefChoice by_foot = foot(ui, content);
  ui.end_panel();
  return by_foot == DebriefChoice::kNone ? chosen : by_foot;
}

DebriefChoice DebriefPage::beside(Ui& ui, const DebriefContent& content, const Area& area) {
  const double gap = ui.px(8),
               head = ui.px(kDebriefHead) + ui.text_height(content.facts.reason, area.width - ui.px(36), true);
  const double left = std::round(kTableShare * area.width), body = area.height - head - gap;
  ui.begin_panel("debrief.head", {area.x, area.y, area.width, head});
  verdict(ui, content);
  ui.heading(content.facts.reason);
  ui.end_panel();
  ui.begin_panel("debrief.rows", {area.x, area.y + head + gap, left, body});
  rows(ui, content);
  ui.end_panel();
  ui.begin_panel("debrief.plots", {area.x + left + gap, area.y + head + gap, area.width - left - gap, body});
  const DebriefChoice choice = plots(ui, content, ui.room_below() / ui.px(1));
  ui.end_panel();
  return choice;
}

DebriefChoice DebriefPage::below(Ui& ui, const DebriefContent& content, const Area& area) {
  ui.begin_panel("debrief", area);
  verdict(ui, content);
  ui.heading(content.facts.reason);
  ui.marked(Mark::kInfo, content.advice, Ink::kHeading);
  ui.gap(4);
  rows(ui, content);
  ui.gap(4);
  const DebriefChoice choice = plots(ui, content, kNarrowPlots);
  ui.end_panel();
  return choice;
}

}  // namespace trocar
