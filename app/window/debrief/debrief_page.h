// The page of the debrief as it is drawn: verdict, table, plots, one advice, what to do next. Knows no model: tests
// give it any result.
//
// Wide windows: table, and what a part means, on the left, plots on the right. Narrow ones: below each other,
// scrolling. Thread: the window's, within a frame.
#pragma once

#include <string>
#include <vector>

#include "app/window/attempt/debrief_facts.h"
#include "app/window/debrief/debrief_plots.h"

namespace trocar {

struct DebriefContent {
  std::string heading = {};  ///< "Surface touch L1, board 4"
  DebriefFacts facts = {};
  std::string advice = {};
  std::vector<std::vector<std::string>> explained = {};  ///< a row of facts each
  DebriefPlots plots = {};                               ///< trace null: not there (yet)
  std::string plots_note = {};                           ///< why there are none
  bool can_watch = false, can_compare = false, guest = false;
  std::string compare_note = {};
  std::string next_name = {};  ///< of the next exercise
};

enum class DebriefChoice : std::uint8_t { kNone, kRetry, kNext, kWatch, kCompare, kProgress, kSignIn, kBack };

class DebriefPage {
 public:
  DebriefChoice draw(Ui& ui, const DebriefContent& content);
  /// Loop time that was chosen in the plots; nothing: the beginning.
  std::optional<double> chosen_s() const { return cursor_s_; }
  int explained_row() const { return explained_; }  ///< -1: none

 private:
  void verdict(Ui& ui, const DebriefContent& content) const;
  void rows(Ui& ui, const DebriefContent& content);
  void explanation(Ui& ui, const DebriefContent& content);
  DebriefChoice plots(Ui& ui, const DebriefContent& content, double height_at_720);
  double foot_height(const Ui& ui, const DebriefContent& content, double wide, bool advised) const;
  DebriefChoice foot(Ui& ui, const DebriefContent& content);
  DebriefChoice beside(Ui& ui, const DebriefContent& content, const Area& area);
  DebriefChoice below(Ui& ui, const DebriefContent& content, const Area& area);

  std::optional<double> cursor_s_;
  bool cursor_set_ = false;
  int explained_ = -1;
};

}  // namespace trocar
