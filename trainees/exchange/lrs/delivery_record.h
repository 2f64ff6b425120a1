// What a record store has been given: a small SQLite file beside the record, its owner's alone. It is no part of the
// record: when it is lost everything is offered again, which changes nothing at the store. Internal to
// trainees/exchange/lrs. Thread: one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

struct sqlite3;

namespace trocar::lrs {

struct Delivered {
  std::string id, about;
};

class DeliveryRecord {
 public:
  /// DATABASE.lrs. @throws InputError: another file. EnvironmentError: cannot be written.
  DeliveryRecord(const std::filesystem::path& database, std::string store);
  ~DeliveryRecord();
  DeliveryRecord(const DeliveryRecord&) = delete;
  DeliveryRecord& operator=(const DeliveryRecord&) = delete;

  bool has(const std::string& id) const;
  /// Statements about something that the store holds and nobody has taken back.
  std::vector<Delivered> holding(const std::string& about) const;
  /// On disk when it returns.
  void add(const std::vector<Delivered>& statements);
  void add_taken_back(const std::string& id);

 private:
  std::string store_;
  sqlite3* connection_ = nullptr;
};

}  // namespace trocar::lrs
