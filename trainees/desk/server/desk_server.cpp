#include "trainees/desk/server/desk_server.h"

#include <arpa/inet.h>
#include <httplib.h>
#include <ifaddrs.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "haptics/input_error.h"
#include "trainees/desk/pages/desk_page.h"
#include "trainees/desk/server/connection.h"
#include "trainees/desk/server/desk_accounts.h"
#include "trainees/desk/server/page_workers.h"
#include "trainees/desk/server/sent_answer.h"
#include "trainees/desk/server/waiting_room.h"

namespace trocar::review {
namespace {

/// A class that signs in together waits its turn, besides the others. More than that many are told to try again.
constexpr int kSignedInAtOnce = 2, kMostSigningIn = 32;

bool signs_in(const Received& received) {
  const auto* request = std::get_if<ReceivedRequest>(&received);
  return request != nullptr && request->head.method == "POST" && request->head.path == "/sign-in";
}
constexpr int kBacklog = 256;

std::vector<std::string> machine_addresses() {
  std::vector<std::string> out;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return out;
  for (const ifaddrs* one = all; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = "";
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    if (::inet_ntop(AF_INET, &address->sin_addr, text, sizeof text)) out.emplace_back(text);
  }
  ::freeifaddrs(all);
  return out;
}

std::string machine_name() {
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) return "";
  return name;
}

/// Accepting is all that the library's own threads are for: what is accepted goes to the waiting room.
class OnTheSpot : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

}  // namespace

struct DeskServer::Impl : httplib::Server {
  explicit Impl(DeskServerOptions given);
  ~Impl() override {
    if (!listened && bound_port > 0) ::close(svr_sock_);
  }
  void bind();
  bool process_and_close_socket(socket_t socket) override;
  void open();
  void close();
  void take(const std::shared_ptr<Connection>& connection, Received received);
  void serve(const std::shared_ptr<Connection>& connection, Received received, Desk* desk);
  Answer answer_to(const Connection& connection, Received received, Desk* desk, bool& head_only);

  DeskServerOptions options;
  std::unique_ptr<TlsIdentity> tls;
  std::unique_ptr<PageWorkers> workers;
  std::unique_ptr<DeskGate> gate;
  std::thread listener;
  std::unique_ptr<httplib::ThreadPool> doors;  ///< those who sign in wait here before they wait for a page
  std::atomic<int> signing_in{0};              ///< served or waiting for `doors`
  std::unique_ptr<WaitingRoom> room;
  int bound_port = 0;
  bool listened = false;  ///< the library closes the port itself, once it has listened
};

DeskServer::Impl::Impl(DeskServerOptions given) : options(std::move(given)) {
  if (options.certificate.empty() != options.key.empty())
    throw InputError("a certificate needs its key, and a key its certificate: give both");
  if (!options.certificate.empty()) tls = std::make_unique<TlsIdentity>(options.certificate, options.key);
  workers = std::make_unique<PageWorkers>(options.page_threads, options.open, options.sources, options.demo);
  if (options.lan) {
    bool somebody = false;
    workers->run("", [&](Desk* desk) { somebody = somebody_can_sign_in(desk->database); });
    if (!somebody)
      throw InputError(
          "on the network everybody signs in, and nobody has an account yet: make one first with"
          " trocar review account add LOGIN --role administrator");
  }
  bind();
  GateOptions gated{.lan = options.lan,
                    .secure = tls != nullptr,
                    .cookie = "trocar_desk_" + std::to_string(bound_port),
                    .port = bound_port,
                    .log = options.log,
                    .sessions = options.sessions,
                    .languages = options.languages};
  gated.hosts = options.names;
  if (tls) {
    const std::vector<std::string> named = tls->names();
    gated.hosts.insert(gated.hosts.end(), named.begin(), named.end());
  }
  if (options.lan) {
    const std::string name = machine_name();
    for (const std::string& host : {name, name.substr(0, name.find('.')), name + ".local"}) gated.hosts.push_back(host);
  }
  for (std::string& host : gated.hosts) {
    std::transform(host.begin(), host.end(), host.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  }
  std::erase_if(gated.hosts, [](const std::string& host) { return host.empty() || host == ".local"; });
  gate = std::make_unique<DeskGate>(std::move(gated), options.routes);
}

void DeskServer::Impl::bind() {
  set_address_family(AF_INET);
  // Without SO_REUSEPORT, which would let two desks share a port unnoticed.
  set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const std::string where = options.lan ? "0.0.0.0" : "127.0.0.1";
  bound_port = options.port == 0 ? bind_to_any_port(where) : bind_to_port(where, options.port) ? options.port : -1;
  if (bound_port <= 0)
    throw EnvironmentError("port " + std::to_string(options.port) + " of " + where +
                           " is taken by another program, or not allowed to this user: "
                           "end that program, or choose another port with --port (0: any that is free)");
  ::listen(svr_sock_, kBacklog);
  new_task_queue = [] { return new OnTheSpot; };
}

void DeskServer::Impl::open() {
  doors = std::make_unique<httplib::ThreadPool>(kSignedInAtOnce);
  RoomLimits limits;
  limits.request = options.limits;
  room = std::make_unique<WaitingRoom>(
      limits, [this](const auto& connection, Received received) { take(connection, std::move(received)); });
}

void DeskServer::Impl::take(const std::shared_ptr<Connection>& connection, Received received) {
  const auto* request = std::get_if<ReceivedRequest>(&received);
  const std::string turn = gate->turn(request ? request->head : RequestHead{}, connection->remote_address());
  const bool door = signs_in(received) && signing_in < kMostSigningIn;
  PageWorkers::Job job = [this, connection, whole = std::make_shared<Received>(std::move(received))](Desk* desk) {
    serve(connection, std::move(*whole), desk);
  };
  if (!door) return workers->give(turn, std::move(job));
  ++signing_in;
  doors->enqueue([this, turn, job = std::move(job)] {
    workers->run(turn, job);
    --signing_in;
  });
}

/// Those who serve first: they still give answers to the room.
void DeskServer::Impl::close() {
  doors->shutdown();
  workers->finish();
  room.reset();
}

bool DeskServer::Impl::process_and_close_socket(socket_t socket) {
  room->enter(std::make_shared<Connection>(socket, tls.get()));
  return true;
}

/// @param desk nullptr: too many wait.
void DeskServer::Impl::serve(const std::shared_ptr<Connection>& connection, Received received, Desk* desk) {
  std::string bytes;
  try {
    bool head_only = false;
    const Answer answer = answer_to(*connection, std::move(received), desk, head_only);
    if (answer.response.status != 0) bytes = answer_bytes(answer.response, gate->headers(answer), head_only);
  } catch (const std::exception& error) {
    if (options.log) options.log(error.what());
  }
  room->send(connection, std::move(bytes));
}

Answer DeskServer::Impl::answer_to(const Connection& connection, Received received, Desk* desk, bool& head_only) {
  if (const auto* refusal = std::get_if<Refusal>(&received))
    return {.response = refusal->status == 0 ? Response{.status = 0} : error_page(refusal->status, refusal->why)};
  auto& request = std::get<ReceivedRequest>(received);
  head_only = request.head.method == "HEAD";
  if (desk == nullptr) return {.response = error_page(503), .retry_after_s = 2};
  const IncomingRequest incoming{.head = std::move(request.head),
                                 .body = std::move(request.body),
                                 .address = connection.remote_address(),
                                 .local_address = connection.local_address(),
                                 .same_user = [&] { return connection.same_user(); }};
  const auto begin = std::chrono::steady_clock::now();
  Answer made = gate->answer(incoming, *desk);
  made.made_in_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return made;
}

DeskServer::DeskServer(DeskServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

DeskServer::~DeskServer() { stop(); }

void DeskServer::start() {
  if (impl_->listener.joinable()) return;
  impl_->listened = true;
  impl_->open();
  impl_->listener = std::thread([this] { impl_->listen_after_bind(); });
  while (!impl_->is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void DeskServer::stop() {
  if (!impl_ || !impl_->listener.joinable()) return;
  impl_->httplib::Server::stop();
  impl_->listener.join();
  impl_->close();
}

int DeskServer::port() const { return impl_->bound_port; }

std::vector<std::string> DeskServer::addresses() const {
  const std::string scheme = impl_->tls ? "https://" : "http://", port = ":" + std::to_string(impl_->bound_port) + "/";
  std::vector<std::string> out{scheme + "127.0.0.1" + port};
  if (!impl_->options.lan) return out;
  for (const std::string& address : machine_addresses()) {
    if (!address.starts_with("127.")) out.push_back(scheme + address + port);
  }
  return out;
}

}  // namespace trocar::review
