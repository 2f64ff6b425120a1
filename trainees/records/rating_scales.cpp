#include "trainees/records/rating_scales.h"

#include "haptics/input_error.h"
#include "trainees/records/assessments.h"

namespace trocar {

const RatingScale& goals_scale() {
  static const RatingScale scale{
      "GOALS",
      "Global Operative Assessment of Laparoscopic Skills",
      {{"depth perception",
        {"overshoots again and again, swings wide, corrects slowly", "overshoots or misses at times, corrects quickly",
         "goes straight to the target in the right plane"}},
       {"bimanual dexterity",
        {"one hand works, the other is idle or in the way", "both hands work, not always together",
         "the hands help each other throughout"}},
       {"efficiency",
        {"hesitates, changes plan, makes no headway", "slow, but planned and in order",
         "sure; changes the plan only for a better one"}},
       {"tissue handling",
        {"rough: tears, pulls too hard, instruments slip", "fair; small damage now and then",
         "gentle, right traction, hardly any damage"}},
       {"autonomy", {"cannot finish even with help", "safe with some help", "safe without help"}}}};
  return scale;
}

const RatingScale& rating_scale(const std::string& name) {
  if (name == goals_scale().name) return goals_scale();
  throw InputError("rating: scale \"" + name + "\" is not known; known: " + goals_scale().name);
}

std::optional<double> RatingSheet::total(const RatingScale& scale) const {
  double sum = 0;
  for (const RatingItem& item : scale.items) {
    const auto value = values.find(item.name);
    if (value == values.end()) return {};
    sum += value->second;
  }
  return sum;
}

std::vector<RatingSheet> rating_sheets(const std::vector<Rating>& ratings, const RatingScale& scale) {
  std::vector<RatingSheet> sheets;
  std::map<std::string, std::size_t> place;  // by account, without one by name
  for (const Rating& rating : ratings) {
    if (rating.scale != scale.name) continue;
    const std::string who = rating.account_uuid.empty() ? "name " + rating.rater : rating.account_uuid;
    const auto [found, added] = place.try_emplace(who, sheets.size());
    if (added) sheets.emplace_back();
    RatingSheet& sheet = sheets[found->second];
    sheet.rater = rating.rater;
    sheet.utc = rating.utc;
    sheet.values[rating.item] = rating.value;
  }
  return sheets;
}

}  // namespace trocar
