// Statements to a learning record store (xAPI 1.0.3 and 2.0): each once, whatever happens on the way.
//
// Identifiers are made of the record, so that sending again is harmless; which statements a store has is written down
// after it has answered for them, never before. A statement that the record no longer says (a later decision on an
// attempt, a question on a certificate that was settled) is taken back there by a voiding one. docs/exports.md. Thread:
// the Database's; blocks on the network.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trainees/exchange/export/xapi_export.h"

namespace trocar {

struct LrsAddress {
  std::string url;                           ///< "https://lrs.example/xapi", before "/statements"
  std::string user = {};                     ///< of basic authentication; "" without
  std::filesystem::path password_file = {};  ///< first line; empty: TROCAR_LRS_PASSWORD. Not readable by others.
  std::filesystem::path authority = {};      ///< PEM of who signed the store's certificate; empty: the system's
  bool plain_http = false;                   ///< http:// beyond this machine
};

struct DeliveryOptions {
  LrsAddress lrs;
  XapiSetting setting = {};
  std::size_t at_once = 50;            ///< statements in a request
  std::chrono::seconds patience{300};  ///< how long altogether is waited for a store that does not take them
  std::function<void(std::size_t done, std::size_t of)> going = {};
  std::function<void(const std::string&)> log = {};          ///< why it waits, a line each
  std::function<void(std::chrono::milliseconds)> wait = {};  ///< empty: sleeps
};

struct DeliveryReport {
  int delivered = 0;                      ///< that the store did not have yet, voiding ones too
  int before = 0;                         ///< delivered by an earlier run
  int different = 0;                      ///< the store holds another statement under the identifier: it stays
  int taken_back = 0;                     ///< of the delivered: voiding ones for what the record no longer says
  std::vector<std::string> refused = {};  ///< "ABOUT: why", a line each; offered again by the next run
};

/// @throws InputError: address, a demo, a statement that would break the standard, no record store at that address,
/// user or password wrong. EnvironmentError: not reached or not answered for longer than `patience`; what was delivered
/// stays, the same call goes on from there.
DeliveryReport deliver_to_lrs(Database& database, const ExportChoice& choice, const PassMark& pass_mark,
                              const DeliveryOptions& options);

}  // namespace trocar
