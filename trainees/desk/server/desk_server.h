// The instructor's desk on the network: HTTP/1.1 by cpp-httplib, one request a connection.
//
//   DeskServer desk(options);      // databases opened, port bound: everything that can fail has failed here
//   desk.start();  ...  desk.stop();
//
// A request is read whole, within limits of size and time, before anything else knows of it (connection.h,
// request_head.h); the gate decides (desk_gate.h); a page is made by one of a few threads that have databases
// (page_workers.h). No file is ever served from the disk.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trainees/desk/server/desk_gate.h"

namespace trocar::review {

struct DeskServerOptions {
  std::function<Database()> open = {};  ///< called once by every page thread, one after the other
  DeskSources sources = {};             ///< called by several threads at once
  std::vector<Route> routes = {};       ///< desk_routes()
  bool demo = false;
  int port = 8642;   ///< 0: any that is free
  bool lan = false;  ///< all addresses of the machine instead of 127.0.0.1; everybody signs in
  std::filesystem::path certificate = {}, key = {};  ///< both: TLS
  std::vector<std::string> names = {};  ///< more names it goes by, besides its addresses and the machine's name
  int page_threads = 4;
  RequestLimits limits = {};
  SessionLimits sessions = {};
  std::shared_ptr<const PageLanguages> languages = {};  ///< besides English
  std::function<void(const std::string&)> log = {};
};

class DeskServer {
 public:
  /// @throws EnvironmentError: port in use or not allowed, database. InputError: certificate or key; --lan without an
  /// account.
  explicit DeskServer(DeskServerOptions options);
  /// Stops.
  ~DeskServer();
  DeskServer(const DeskServer&) = delete;
  DeskServer& operator=(const DeskServer&) = delete;

  /// Returns when it listens.
  void start();
  /// Ends what runs within some 100 ms; answers that pages are made for are waited for.
  void stop();

  int port() const;
  /// "http://127.0.0.1:8642/", and with `lan` one for every address of the machine.
  std::vector<std::string> addresses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trocar::review
