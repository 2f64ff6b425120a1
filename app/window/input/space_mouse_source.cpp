#include <dlfcn.h>

#include <hidapi.h>

#include "app/window/input/space_mouse.h"

namespace trocar {
namespace {

/// The few functions of hidapi that are called, or null.
struct HidLibrary {
  void* handle = nullptr;
  decltype(&hid_init) init = nullptr;
  decltype(&hid_enumerate) enumerate = nullptr;
  decltype(&hid_free_enumeration) free_enumeration = nullptr;
  decltype(&hid_open_path) open_path = nullptr;
  decltype(&hid_read_timeout) read_timeout = nullptr;
  decltype(&hid_close) close = nullptr;

  bool complete() const { return init && enumerate && free_enumeration && open_path && read_timeout && close; }
};

template <class Function>
void find(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
}

HidLibrary open_library() {
  HidLibrary hid;
  hid.handle = dlopen("libhidapi-hidraw.so.0", RTLD_NOW | RTLD_LOCAL);
  if (!hid.handle) return hid;
  find(hid.handle, "hid_init", hid.init);
  find(hid.handle, "hid_enumerate", hid.enumerate);
  find(hid.handle, "hid_free_enumeration", hid.free_enumeration);
  find(hid.handle, "hid_open_path", hid.open_path);
  find(hid.handle, "hid_read_timeout", hid.read_timeout);
  find(hid.handle, "hid_close", hid.close);
  return hid;
}

class UsbSpaceMice final : public SpaceMouseSource {
 public:
  ~UsbSpaceMice() override { close(); }  // the library stays loaded: unloading one that started threads is no gain

  bool open() override {
    if (!tried_) hid_ = open_library();
    if (!tried_ && hid_.complete()) hid_.init();
    tried_ = true;
    if (!hid_.complete()) return false;
    for (const unsigned short vendor : {0x256f, 0x046d}) {
      hid_device_info* all = hid_.enumerate(vendor, 0);
      for (const hid_device_info* one = all; one && !device_; one = one->next)
        if (is_space_mouse(one->vendor_id, one->product_id, one->usage_page, one->usage))
          device_ = hid_.open_path(one->path);
      hid_.free_enumeration(all);
    }
    return device_ != nullptr;
  }

  int read(std::span<std::uint8_t> report, int timeout_ms) override {
    return hid_.read_timeout(device_, report.data(), report.size(), timeout_ms);
  }

  void close() override {
    if (device_) hid_.close(device_);
    device_ = nullptr;
  }

 private:
  HidLibrary hid_;
  hid_device* device_ = nullptr;
  bool tried_ = false;
};

}  // namespace

std::unique_ptr<SpaceMouseSource> usb_space_mice() { return std::make_unique<UsbSpaceMice>(); }

}  // namespace trocar
