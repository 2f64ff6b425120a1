#include "trainees/exchange/lrs/delivery_record.h"

#include <sqlite3.h>

#include "trainees/files/owner_file.h"
#include "trainees/records/attempt_identity.h"
#include "trainees/store/sqlite_handle.h"

namespace trocar::lrs {
namespace {

constexpr int kWait_ms = 5000;

}  // namespace

DeliveryRecord::DeliveryRecord(const std::filesystem::path& database, std::string store) : store_(std::move(store)) {
  const std::string file = database.string() + ".lrs";
  make_owner_file(file);
  const int opened = sqlite3_open(file.c_str(), &connection_);
  try {
    if (opened != SQLITE_OK) sql::raise(connection_, opened, "open");
    sqlite3_busy_timeout(connection_, kWait_ms);
    sql::execute(connection_,
                 "CREATE TABLE IF NOT EXISTS delivered (store TEXT NOT NULL, id TEXT NOT NULL, about TEXT NOT NULL,"
                 " utc TEXT NOT NULL, taken_back INTEGER NOT NULL DEFAULT 0, PRIMARY KEY (store, id));"
                 "CREATE INDEX IF NOT EXISTS delivered_about ON delivered (store, about)");
  } catch (...) {
    sqlite3_close_v2(connection_);
    throw;
  }
}

DeliveryRecord::~DeliveryRecord() { sqlite3_close_v2(connection_); }

bool DeliveryRecord::has(const std::string& id) const {
  sql::Statement row(connection_, "SELECT 1 FROM delivered WHERE store = ? AND id = ?");
  return row.bind(store_).bind(id).step();
}

std::vector<Delivered> DeliveryRecord::holding(const std::string& about) const {
  sql::Statement rows(connection_,
                      "SELECT id, about FROM delivered WHERE store = ? AND about = ? AND taken_back = 0 ORDER BY utc");
  rows.bind(store_).bind(about);
  std::vector<Delivered> out;
  while (rows.step()) out.push_back({rows.text(0), rows.text(1)});
  return out;
}

void DeliveryRecord::add(const std::vector<Delivered>& statements) {
  sql::Transaction transaction(connection_);
  sql::Statement insert(connection_, "INSERT OR IGNORE INTO delivered (store, id, about, utc) VALUES (?, ?, ?, ?)");
  for (const Delivered& one : statements) insert.bind(store_).bind(one.id).bind(one.about).bind(utc_now()).run();
  transaction.commit();
}

void DeliveryRecord::add_taken_back(const std::string& id) {
  sql::Statement update(connection_, "UPDATE delivered SET taken_back = 1 WHERE store = ? AND id = ?");
  update.bind(store_).bind(id).run();
}

}  // namespace trocar::lrs
