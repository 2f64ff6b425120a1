// Programmes (trainees/progress/programme.h) as curricula of their name, and whom they are assigned to. Sealed rows: an
// assignment that is withdrawn stays, with who withdrew it and why. Thread: that of the Database.
//
// What holds is the newest version of a programme. A group's assignment holds for whoever is in the group, as long as
// they are; one to the person goes before those to their groups, and of several the newest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trainees/progress/programme.h"
#include "trainees/records/curricula.h"

namespace trocar {

struct KeptProgramme {
  Curriculum text = {};
  Programme programme = {};
  std::string problem = {};  ///< why the text cannot be read; then there are no steps
};

struct Assignment {
  std::string uuid = {}, programme = {}, trainee = {}, group = {};  ///< code, or group; the other is ""
  std::string due = {}, printed = {}, utc = {};                     ///< due: "2026-06-30", "" without
  std::string withdrawn_utc = {}, withdrawn_by = {}, withdrawn_reason = {};
};

class ProgrammeStore {
 public:
  explicit ProgrammeStore(Database& database) : database_(&database) {}

  /// The next version. @throws InputError: as read_programme() and CurriculumStore::add(); the name is that of the
  /// rules in force or of another kind of curriculum.
  Curriculum save(const std::string& name, const std::string& toml, const Author& author,
                  const CurriculumStore::Check& check = {});
  /// Newest versions, by name.
  std::vector<KeptProgramme> list() const;
  /// @throws InputError: no programme of that name, or its text cannot be read.
  Programme find(const std::string& name) const;

  /// To one person or to one group; what held for them of that programme is withdrawn as replaced.
  /// @param due "2026-06-30", "" for none. @throws InputError: no such programme, person or group, both or neither, no
  /// day, the same holds already, the station's key is lost.
  Assignment assign(const std::string& programme, const std::string& trainee, const std::string& group,
                    const std::string& due, const Author& author);
  /// @param reason up to 200 bytes, may be "". @throws InputError: no such assignment, or withdrawn before; the
  /// station's key is lost.
  void withdraw(const std::string& uuid, const std::string& reason, const Author& author);
  /// Newest first, withdrawn ones too.
  std::vector<Assignment> assignments() const;

 private:
  Database* database_;
};

}  // namespace trocar
