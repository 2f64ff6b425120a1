#include "app/desk/desk_sources.h"

#include <ostream>

#include "app/desk/desk_facts.h"
#include "app/session/grading/recorded_result.h"
#include "app/session/keeping/recording_check.h"
#include "app/session/recording/recording_reader.h"
#include "haptics/input_error.h"
#include "scenarios/scoring/metrics.h"

namespace trocar {
namespace {

Trace trace_of(const std::filesystem::path& file) {
  const Recording recording = read_recording(file, Reading::kTolerant);
  return rebuild_trace(recording.ticks, recording.rate_hz);
}

StiffnessReport stiffness_of(const std::filesystem::path& file) {
  return recorded_stiffness(read_recording(file, Reading::kTolerant), file.string());
}

std::string words_of_metric(const std::string& metric) {
  const MetricDefinition* known = find_metric(metric);
  return known ? std::string(known->meaning) : "";
}

}  // namespace

std::function<Database()> desk_opener(const std::filesystem::path& file) {
  constexpr int kBusy_ms = 5000;
  return [file] { return Database(file, OpenMode::kExisting, kBusy_ms); };
}

std::unique_ptr<DeskPictures> desk_pictures(const std::filesystem::path& file, std::ostream& err) {
  try {
    return std::make_unique<DeskPictures>(find_assets(), desk_opener(file));
  } catch (const EnvironmentError& error) {
    err << "no pictures of attempts: " << error.what() << '\n';
    return nullptr;
  }
}

std::unique_ptr<DeskFilms> desk_films(const std::filesystem::path& file, std::string& why) {
  try {
    why = DeskFilms::refusal();
    return std::make_unique<DeskFilms>(find_assets(), file, desk_opener(file));
  } catch (const EnvironmentError& error) {
    if (why.empty()) why = std::string("No film: ") + error.what();
    return nullptr;
  }
}

review::DeskSources desk_sources() {
  review::DeskSources out;
  out.trace = trace_of;
  out.foreign_recording = foreign_recording;
  out.stiffness = stiffness_of;
  out.metric_words = words_of_metric;
  out.level_facts = desk_level_facts;
  out.grip_limits = desk_grip_limits;
  for (const MetricDefinition& metric : metric_catalogue()) out.metrics.emplace_back(metric.name);
  return out;
}

}  // namespace trocar
