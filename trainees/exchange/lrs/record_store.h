// A learning record store over HTTP: asked what it speaks, given statements. libcurl stays in its source. Internal to
// trainees/exchange/lrs. Thread: one.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trainees/exchange/export/xapi.h"
#include "trainees/exchange/lrs/lrs_delivery.h"

namespace trocar::lrs {

struct Answer {
  long status = 0;           ///< of HTTP; 0: none came
  std::string body = {};     ///< 1 MiB at most
  long retry_after_s = 0;    ///< as the store asks; 0: it does not
  std::string failure = {};  ///< why none came
};

class RecordStore {
 public:
  /// @throws InputError: no address of HTTP, credentials in it or without TLS beyond this machine, password file unfit.
  explicit RecordStore(const LrsAddress& address);
  ~RecordStore();
  RecordStore(const RecordStore&) = delete;
  RecordStore& operator=(const RecordStore&) = delete;

  /// What it says of itself; needs no password.
  Answer about();
  /// Some at once: all or none.
  Answer post(const std::vector<XapiStatement>& statements);
  /// One, under its identifier.
  Answer put(const XapiStatement& statement);
  /// Of the statements that follow. @param version "1.0.3", "2.0.0"
  void speak(const std::string& version);

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace trocar::lrs
