#include "app/cli/machine/doctor_probes.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "haptics/device/mc4000/pci_bus.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

constexpr int kConnect_ms = 1000;

bool connects(int family, const sockaddr* address, socklen_t size) {
  const int socket = ::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  bool connected = ::connect(socket, address, size) == 0;
  if (!connected && errno == EINPROGRESS) {
    pollfd ready{socket, POLLOUT, 0};
    int error = 0;
    socklen_t room = sizeof error;
    connected = ::poll(&ready, 1, kConnect_ms) == 1 && ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &room) == 0 &&
                error == 0;
  }
  ::close(socket);
  return connected;
}

/// @param name of a socket's file; with a zero byte before it one without a file.
bool connects_to_file(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() >= sizeof address.sun_path) return false;
  std::memcpy(address.sun_path, name.data(), name.size());
  return connects(AF_UNIX, reinterpret_cast<const sockaddr*>(&address),
                  static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size()));
}

bool connects_to_port(const std::string& host, int port) {
  addrinfo* found = nullptr;
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return false;
  bool connected = false;
  for (const addrinfo* one = found; one && !connected; one = one->ai_next)
    connected = connects(one->ai_family, one->ai_addr, one->ai_addrlen);
  ::freeaddrinfo(found);
  return connected;
}

std::string driver_of(const fs::path& folder) {
  std::error_code error;
  return fs::read_symlink(folder / "driver", error).filename().string();
}

bool may_use(const fs::path& file) { return ::access(file.c_str(), R_OK | W_OK) == 0; }

std::string no_right(const fs::path& file) {
  return file.string() + ": this user may not read and write it: run as root, or sudo chown $USER " + file.string() +
         " (until the computer starts anew; a udev rule for good)";
}

}  // namespace

bool x_answers(const std::string& display) {
  constexpr int kFirstPort = 6000, kMostDisplay = 59535;
  const std::size_t colon = display.rfind(':');
  if (colon == std::string::npos) return false;
  const std::string host = display.substr(0, colon);
  const std::string number = display.substr(colon + 1, display.find('.', colon) - colon - 1);
  if (number.empty() || number.size() > 5 ||
      !std::all_of(number.begin(), number.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
    return false;
  if (!host.empty() && host != "unix")
    return std::stoi(number) <= kMostDisplay && connects_to_port(host, kFirstPort + std::stoi(number));
  const std::string socket = "/tmp/.X11-unix/X" + number;
  return connects_to_file(socket) || connects_to_file(std::string(1, '\0') + socket);
}

bool wayland_answers(const std::string& display) {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  return connects_to_file(display.starts_with('/') ? display : std::string(folder ? folder : "") + "/" + display);
}

bool names_boards(const std::string& card) { return card.find_first_of("/,") != std::string::npos; }

BoardLook look_at_board(const std::string& device) {
  std::error_code error;
  const bool node = device.starts_with("/dev/uio");
  const fs::path registers = board_registers(device);
  BoardLook look{.driver = driver_of(registers.parent_path())};
  if (!fs::exists(device, error))
    look.trouble = device + (node ? ": is not there; bind the board to uio_pci_generic (docs/real_hardware.md)"
                                  : ": is not there; lspci -D lists the boards of this computer");
  else if (node && !may_use(device))
    look.trouble = no_right(device);
  else if (!fs::exists(registers, error))
    look.trouble =
        device + ": has no resource0, so no registers that a program can reach; is it a PCI device's folder?";
  else if (!may_use(registers))
    look.trouble = no_right(registers);
  else if (const auto bytes = fs::file_size(registers, error); error || bytes < kLeastBoardBytes)
    look.trouble = registers.string() + ": has too few registers for a board of the thesis; lspci -D lists the others";
  return look;
}

}  // namespace trocar
