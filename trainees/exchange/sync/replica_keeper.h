// Keeps a copy of a central record fresh while a desk serves it: what is written at the desk goes there within a
// second, what others pushed comes within two.
//
// A thread with a Database and a connection of its own asks the centre for one number (the newest arrival) every two
// seconds, and the copy for the head of its audit trail four times a second: nobody has to call it, and nothing is lost
// when the program ends, because what has not been pushed stands in the trail. While the centre cannot be reached it
// tries again every five seconds. Why a copy and not the centre itself: docs/decisions/0011-central-desk.md. Thread:
// status() any, the rest that which made it.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "trainees/exchange/sync/replica_status.h"
#include "trainees/exchange/sync/synchronise.h"

namespace trocar {

/// $XDG_CACHE_HOME/trocar/central-NAME.db, else ~/.cache/trocar/..., by the address. @throws EnvironmentError without
/// HOME.
std::filesystem::path default_replica_path(const CentralAddress& central);
/// Host and database of the address, for people: "central.example/trocar".
std::string central_name(const CentralAddress& central);

struct KeeperOptions {
  CentralAddress central;
  std::function<Database()> open = {};  ///< the copy; called once, by the thread that makes the keeper
  std::string station_name = "desk";
  bool recordings = false;
  std::chrono::milliseconds look{250}, ask{2000}, retry{5000};  ///< at the copy, at the centre, when it is lost
  std::chrono::seconds compare_all{900};                        ///< everything is compared and not only what is new
  std::function<void(const std::string&)> log = {};  ///< one line; the keeper's thread, and before it runs the maker's
  std::function<void(std::size_t attempts, std::size_t of)> going = {};  ///< of the first exchange
};

class ReplicaKeeper {
 public:
  /// The first exchange. A centre that is not reached is no fault when the copy has been filled before.
  /// @throws as replicate_central.
  explicit ReplicaKeeper(KeeperOptions options);
  /// Ends the thread; a statement that is under way is waited for, 30 s at the most.
  ~ReplicaKeeper();
  ReplicaKeeper(const ReplicaKeeper&) = delete;
  ReplicaKeeper& operator=(const ReplicaKeeper&) = delete;

  void start();
  ReplicaStatus status() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trocar
