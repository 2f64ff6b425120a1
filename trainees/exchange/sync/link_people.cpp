// Who is the same person as whom: said by somebody, never guessed, kept with who said it, and taken back in the same
// way.
#include <algorithm>
#include <utility>

#include "haptics/input_error.h"
#include "trainees/exchange/sync/links.h"
#include "trainees/exchange/sync/synchronise.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/records/printed_text.h"

namespace trocar {
namespace {

using namespace sync;  // NOLINT(google-build-using-namespace): this file is its public side

std::string only_one(const std::vector<Values>& rows, const std::string& name, const std::string& none) {
  if (rows.empty()) throw InputError("\"" + name + "\": " + none);
  if (rows.size() == 1) return *rows.front()[0];
  throw InputError("\"" + name + "\": stands for " + std::to_string(rows.size()) +
                   " trainees; give the UUID of one or of the station");
}

std::string trainee_named(CentralLink& link, const std::string& name) {
  const std::size_t at = name.rfind('@');
  if (at == std::string::npos) {
    return only_one(link.run("SELECT uuid FROM trainee WHERE uuid = $1", {name}), name,
                    "no trainee of that UUID is at the centre; or give CODE@STATION");
  }
  return only_one(
      link.run(
          "SELECT p.trainee_uuid FROM person p JOIN station s ON s.uuid = p.station WHERE lower(p.code) = lower($1) AND"
          " (s.uuid = $2 OR s.name = $2) ORDER BY p.trainee_uuid",
          {name.substr(0, at), name.substr(at + 1)}),
      name, "the centre knows no such code of that station; codes go there with trocar sync --to URL --with-identity");
}

/// Rows of an erased person are gone, and what is left belongs to nobody who can be told.
void require_not_erased(CentralLink& link, const std::string& trainee, const std::string& name) {
  if (link.run("SELECT 1 FROM erased_trainee WHERE trainee_uuid = $1", {trainee}).empty()) return;
  throw InputError("\"" + name +
                   "\": was erased, alone or with whom they were linked; that is neither linked nor parted any more");
}

}  // namespace

LinkedPeople link_people(const CentralAddress& central, const std::string& one, const std::string& other, bool linked,
                         const std::string& author) {
  check_printed("author", author);
  CentralLink link(central);
  link.begin();
  if (link.run("SELECT may_all()").front().front() != "t")
    throw InputError("who is the same person as whom only a desk's login or the owner of the central database says");
  LinkedPeople people{trainee_named(link, one), trainee_named(link, other)};
  if (people.one == people.other) throw InputError("\"" + one + "\" and \"" + other + "\" are one trainee already");
  require_not_erased(link, people.one, one);
  require_not_erased(link, people.other, other);
  if (people.other < people.one) std::swap(people.one, people.other);
  const Links links(link);
  const auto same = links.same_as(people.one);
  const bool joined = std::find(same.begin(), same.end(), people.other) != same.end();
  const bool said =
      !link.run("SELECT 1 FROM holding_link WHERE one = $1 AND other = $2", {people.one, people.other}).empty();
  if (linked && joined) throw InputError("\"" + one + "\" and \"" + other + "\" are linked already");
  if (!linked && !said) {
    throw InputError("\"" + one + "\" and \"" + other + "\" were not linked with each other" +
                     (joined ? ", but through a third: part one of them from that one" : ""));
  }
  link.run("INSERT INTO person_link (one, other, linked, author, utc) VALUES ($1, $2, $3::boolean, $4, $5)",
           {people.one, people.other, linked ? "true" : "false", author, utc_now()});
  link.touch();
  link.commit();
  return people;
}

}  // namespace trocar
