// Scales by which a person rates an attempt from its replay. No program fills one in: its numbers agree with raters too
// weakly for that.
//
// GOALS: Vassiliou and others, Am J Surg 2005 (PMID 15972181): five items, 1 to 5, sum 5 to 25; the anchors at 1, 3 and
// 5 are in words of our own. Thread: any.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trocar {

struct Rating;

struct RatingItem {
  std::string name = {};
  std::array<std::string, 3> anchors = {};  ///< what 1, 3 and 5 look like
};

struct RatingScale {
  std::string name = {}, title = {};
  std::vector<RatingItem> items = {};
  int least = 1, most = 5;
};

const RatingScale& goals_scale();
/// @throws InputError: no such scale; names the known ones.
const RatingScale& rating_scale(const std::string& name);

/// What one person said of one attempt on one scale: of each item their newest value.
struct RatingSheet {
  std::string rater = {}, utc = {};           ///< of their newest value
  std::map<std::string, double> values = {};  ///< by item; one that was not rated is missing
  /// Sum; empty unless every item of the scale is rated.
  std::optional<double> total(const RatingScale& scale) const;
};

/// In the order in which the raters first rated. @param ratings oldest first.
std::vector<RatingSheet> rating_sheets(const std::vector<Rating>& ratings, const RatingScale& scale);

}  // namespace trocar
