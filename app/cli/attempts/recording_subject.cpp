#include "app/cli/attempts/recording_subject.h"

#include <ostream>

#include "app/cli/records/open_database.h"
#include "haptics/input_error.h"
#include "trainees/records/attempt_store.h"

namespace trocar {

Subject find_subject(const std::string& name, const std::filesystem::path& database, std::ostream& err) {
  Subject subject;
  std::optional<Database> open;
  if (std::filesystem::is_regular_file(name)) {
    subject.file = name;
  } else {
    if (name.find('/') != std::string::npos || name.find('.') != std::string::npos) {
      throw InputError(name + ": no such recording");
    }
    open.emplace(open_database(database, OpenMode::kExisting, err));
    subject.stored = AttemptStore(*open).load(name);
    subject.file = subject.stored->recording_path;
    if (subject.file.empty()) throw InputError("attempt " + subject.stored->uuid + " was not recorded to a file");
  }
  subject.recording = read_recording(subject.file);
  if (!subject.recording.torn.empty())
    err << "trocar: " << subject.file.string() << ": " << subject.recording.torn << '\n';
  if (subject.stored && subject.stored->recording_sha256 != subject.recording.sha256) {
    throw InputError(subject.file.string() + ": the recording is not the one that was graded (its sha256 differs)");
  }
  if (open) {
    const Recording& made = subject.recording;
    if (const std::string problem =
            AttemptStore(*open).recording_problem(subject.stored->uuid, made.attempt, made.signed_by);
        !problem.empty())
      throw InputError(subject.file.string() + ": " + problem);
  }
  return subject;
}

}  // namespace trocar
