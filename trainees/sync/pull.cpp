#include "trainees/sync/fetch.h"
#include "trainees/sync/synchronise.h"

namespace trocar {

PullReport pull_from_central(Database& database, const CentralAddress& central, bool apply_erasures) {
  sync::CentralLink link(central);
  PullReport report;
  link.begin_reading();
  for (const char* table : {"curriculum", "benchmark"}) sync::take_sealed(link, database, sync::carried_sealed(table), report);
  sync::take_erasures(link, database, apply_erasures, report);
  link.commit();
  return report;
}

}  // namespace trocar
