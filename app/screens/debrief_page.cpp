#include "app/screens/debrief_page.h"

#include <algorithm>

namespace trocar {
namespace {

constexpr double kTwoColumns = 1000, kMargin = 20, kHead = 128, kNarrowPlots = 300;   // px at 720 lines and scale 1

Mark verdict_mark(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass: return Mark::kTick;
    case Outcome::kNotYet: return Mark::kHalf;
    case Outcome::kStopped: return Mark::kOpen;
    case Outcome::kDeviceStopped:
    case Outcome::kVoid: return Mark::kWarning;
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
  const double bar = ui.px(14), y = area.y + ui.line_height() + ui.px(6), pass_x = area.x + area.width * facts.pass_at / 100;
  const Words& w = ui.words();
  ui.text_at(area.x, area.y, w("{0} of 100 points", {w.number(*facts.score, 1)}), Ink::kText, area.width, 0, true);
  ui.paint_frame({area.x, y, area.width, bar}, Ink::kDim, 1, ui.px(3));
  const bool pass = facts.outcome == Outcome::kPass;
  ui.paint_box({area.x, y, area.width * *facts.score / 100, bar}, pass ? Ink::kGood : Ink::kCaution, 1, ui.px(3));
  ui.paint_line(pass_x, y - ui.px(4), pass_x, y + bar + ui.px(4), Ink::kText, 2);
  ui.text_at(pass_x, y + bar + ui.px(6), w("pass {0}", {w.number(facts.pass_at, 0)}), Ink::kDim, 0, 0.5);
}

Ui::Cell median_cell(const DebriefRow& row) {
  const Mark mark = row.against_median > 0 ? Mark::kUp : row.against_median < 0 ? Mark::kDown : Mark::kNone;
  return {row.median, Ink::kDim, mark, false};
}

struct Columns {
  std::vector<std::string> heads;
  std::vector<double> shares;
  bool anchors, own, expert;
};

/// As many columns as fit; what is left out stands in the explanation.
Columns columns(const Ui& ui, const DebriefFacts& facts, double room) {
  const Words& w = ui.words();
  const auto any = [&](std::string DebriefRow::*text) {
    return std::any_of(facts.rows.begin(), facts.rows.end(), [&](const DebriefRow& row) { return !(row.*text).empty(); });
  };
  Columns c{{w("Part"), w("Measured"), w("You")}, {0.17, 0.25, 0.13}, room >= ui.px(560), false, false};
  c.own = c.anchors && any(&DebriefRow::median);
  c.expert = c.anchors && any(&DebriefRow::expert);
  if (c.anchors) {
    c.heads.insert(c.heads.end(), {w("All at"), w("None at")});
    c.shares.insert(c.shares.end(), {0.12, 0.13});
  }
  c.heads.push_back(w("Lost"));
  c.shares.push_back(0.11);
  if (c.own) {
    c.heads.insert(c.heads.end(), {w("Best"), w("Median")});
    c.shares.insert(c.shares.end(), {0.12, 0.15});
  }
  if (c.expert) {
    c.heads.push_back(w("Expert"));
    c.shares.push_back(0.12);
  }
  return c;
}

std::vector<Ui::Cell> cells(const Words& w, const DebriefRow& row, bool first_of_group, const Columns& c) {
  std::vector<Ui::Cell> out{{first_of_group ? group_name(w, row.group) : "", Ink::kDim},
                            {row.name, row.failed ? Ink::kAlarm : Ink::kText, row_mark(row)},
                            {row.value, Ink::kText}};
  if (c.anchors) {
    out.push_back({row.full, Ink::kDim});
    out.push_back({row.none, Ink::kDim});
  }
  out.push_back({w.number(row.lost, 1), row.lost >= 0.05 ? Ink::kText : Ink::kDim});
  if (c.own) {
    out.push_back({row.best, Ink::kDim});
    out.push_back(median_cell(row));
  }
  if (c.expert) out.push_back({row.expert, Ink::kDim});
  return out;
}

/// px that a button takes.
double button_width(const Ui& ui, const std::string& text, const std::string& key) {
  return ui.text_width(text) + ui.text_width("[" + key + "]") + ui.px(46);
}

}  // namespace

void DebriefPage::verdict(Ui& ui, const DebriefContent& content) const {
  const DebriefFacts& facts = content.facts;
  const double all = ui.room(), side = ui.px(44), bar = facts.score && all >= ui.px(700) ? ui.px(250) : 0;
  const Area area = ui.drawing("verdict", 48);
  ui.paint_mark(verdict_mark(facts.outcome), area.x, area.y, side);
  const double x = area.x + side + ui.px(14);
  const double room = area.x + area.width - x - (bar > 0 ? bar + ui.px(24) : 0);
  ui.text_at(x, area.y - ui.px(2), facts.verdict, facts.outcome == Outcome::kPass ? Ink::kGood : Ink::kCaution, room, 0, true);
  ui.text_at(x, area.y + ui.px(25), content.heading, Ink::kDim, room);
  if (bar > 0) score_bar(ui, facts, {area.x + area.width - bar, area.y, bar, area.height});
}

void DebriefPage::rows(Ui& ui, const DebriefContent& content) {
  const Words& w = ui.words();
  const DebriefFacts& facts = content.facts;
  if (facts.rows.empty()) return;
  const Columns c = columns(ui, facts, ui.room());
  std::vector<std::vector<Ui::Cell>> table;
  for (std::size_t i = 0; i < facts.rows.size(); ++i)
    table.push_back(cells(w, facts.rows[i], i == 0 || facts.rows[i].group != facts.rows[i - 1].group, c));
  const int chosen = ui.table("rows", c.heads, c.shares, table);
  const int count = static_cast<int>(facts.rows.size());
  if (chosen >= 0) explained_ = explained_ == chosen ? -1 : chosen;
  else if (ui.pressed("E")) explained_ = explained_ + 1 >= count ? -1 : explained_ + 1;
  if (facts.lost_to_caps >= 0.05)
    ui.marked(Mark::kWarning, w("A cap took {0} more points: the score counts no higher while a safety rule is broken or the task undone.",
                                {w.number(facts.lost_to_caps, 1)}), Ink::kCaution);
  ui.text(w("[E] or a row: what a part means and how it is scored. Arrows: better or worse than your median."), Ink::kDim);
}

void DebriefPage::explanation(Ui& ui, const DebriefContent& content) {
  const auto row = static_cast<std::size_t>(explained_);
  ui.heading(content.facts.rows[row].name);
  for (const std::string& sentence : content.explained[row]) ui.text(sentence);
  const DebriefRow& shown = content.facts.rows[row];
  if (!shown.median.empty())
    ui.text(ui.words()("Your best so far {0}, your median {1}.", {shown.best, shown.median}), Ink::kDim);
  if (!shown.expert.empty()) ui.text(ui.words()("The expert hand on the same board: {0}.", {shown.expert}), Ink::kDim);
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
  const Words& w = ui.words();
  DebriefChoice choice = DebriefChoice::kNone;
  ui.marked(Mark::kInfo, content.advice, Ink::kHeading);
  bool first = true;
  const auto add = [&](const char* id, const std::string& text, const std::string& key, DebriefChoice means, bool strong = false) {
    const std::string shown = strong ? "Enter" : key;
    if (!first) {
      ui.same_line();
      if (ui.room() < button_width(ui, text, shown)) ui.gap(0);
    }
    first = false;
    if (ui.button(id, text, shown, strong) || (strong && ui.pressed(key))) choice = means;
  };
  const bool onward = content.facts.outcome == Outcome::kPass;
  const std::string next = content.next_name.empty() ? w("Next") : w("Next: {0}", {content.next_name});
  if (onward) add("next", next, "N", DebriefChoice::kNext, true);
  add("retry", w("Try again"), "R", DebriefChoice::kRetry, !onward);
  if (!onward) add("next", next, "N", DebriefChoice::kNext);
  if (content.can_watch) {
    const double from = content.plots.trace && cursor_s_ ? std::max(0.0, *cursor_s_ - content.plots.trace->begin_s - 3) : 0;
    add("watch", w("Watch from {0} s", {w.number(from, 0)}), "W", DebriefChoice::kWatch);
  }
  if (content.can_compare) add("compare", w("Compare with expert"), "S", DebriefChoice::kCompare);
  add("progress", w("My progress"), "M", DebriefChoice::kProgress);
  if (content.guest) add("signin", w("Sign in"), "I", DebriefChoice::kSignIn);
  if (!content.compare_note.empty()) ui.text(content.compare_note, Ink::kDim);
  else if (content.guest) ui.text(w("Sign in to keep your runs under your own code; this one is kept as a guest's."), Ink::kDim);
  return choice;
}

DebriefChoice DebriefPage::draw(Ui& ui, const DebriefContent& content) {
  const double margin = std::min(ui.px(kMargin), 0.02 * ui.width()), gap = ui.px(8);
  const double wide = ui.width() - 2 * margin, high = ui.height() - 2 * margin;
  const bool two = wide >= ui.px(kTwoColumns);
  if (explained_ >= static_cast<int>(content.facts.rows.size())) explained_ = -1;
  const auto reasons = [&] {
    ui.gap(2);
    ui.heading(content.facts.reason);
    for (const std::string& sentence : content.facts.more) ui.marked(Mark::kInfo, sentence, Ink::kText);
  };
  DebriefChoice choice = DebriefChoice::kNone;
  const auto take = [&](DebriefChoice made) { choice = made == DebriefChoice::kNone ? choice : made; };
  const double foot_high = ui.px(two ? 116 : 150), head = two ? ui.px(kHead) : 0;
  if (two) {
    ui.begin_panel("debrief.head", {margin, margin, wide, head});
    verdict(ui, content);
    reasons();
    ui.end_panel();
    const double left = 0.56 * wide, body = high - head - foot_high - 2 * gap;
    ui.begin_panel("debrief.rows", {margin, margin + head + gap, left, body});
    rows(ui, content);
    ui.end_panel();
    ui.begin_panel("debrief.plots", {margin + left + gap, margin + head + gap, wide - left - gap, body});
    if (explained_ >= 0) explanation(ui, content);
    else take(plots(ui, content, ui.room_below() / ui.px(1)));
    ui.end_panel();
  } else {
    ui.begin_panel("debrief", {margin, margin, wide, high - foot_high - gap});
    verdict(ui, content);
    reasons();
    ui.gap(6);
    rows(ui, content);
    if (explained_ >= 0) explanation(ui, content);
    ui.gap(6);
    take(plots(ui, content, kNarrowPlots));
    ui.end_panel();
  }
  ui.begin_panel("debrief.foot", {margin, margin + high - foot_high, wide, foot_high});
  take(foot(ui, content));
  ui.end_panel();
  return choice;
}

}  // namespace trocar
