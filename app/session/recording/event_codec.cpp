#include "app/session/recording/event_codec.h"

#include "app/session/recording/byte_order.h"

namespace trocar {
namespace {

void put_text(std::string& out, const std::string& text) {
  if (text.size() > 0xFFFF) throw InputError("recording: an event's text is longer than 65535 bytes");
  bytes::put(out, static_cast<std::uint16_t>(text.size()));
  out += text;
}

std::string take_text(bytes::Reader& reader) {
  const auto size = reader.take<std::uint16_t>();
  return std::string(reader.take_bytes(size));
}

Event take_event(bytes::Reader& reader) {
  Event event;
  event.t_s = reader.take_double();
  const auto severity = reader.take<std::uint8_t>();
  if (severity > static_cast<std::uint8_t>(Severity::kCritical)) throw InputError("an event has an unknown severity");
  event.severity = static_cast<Severity>(severity);
  event.object = static_cast<std::int32_t>(reader.take<std::uint32_t>());
  event.value = reader.take_double();
  for (int axis = 0; axis < 3; ++axis) event.tip_T[axis] = reader.take_double();
  event.type = take_text(reader);
  event.unit = take_text(reader);
  return event;
}

}  // namespace

std::string encode_events(std::span<const Event> events) {
  std::string payload;
  bytes::put(payload, static_cast<std::uint32_t>(events.size()));
  for (const Event& event : events) {
    bytes::put_double(payload, event.t_s);
    bytes::put(payload, static_cast<std::uint8_t>(event.severity));
    bytes::put(payload, static_cast<std::uint32_t>(event.object));
    bytes::put_double(payload, event.value);
    for (int axis = 0; axis < 3; ++axis) bytes::put_double(payload, event.tip_T[axis]);
    put_text(payload, event.type);
    put_text(payload, event.unit);
  }
  return payload;
}

std::vector<Event> decode_events(std::string_view payload) {
  bytes::Reader reader(payload);
  const auto count = reader.take<std::uint32_t>();
  std::vector<Event> events;
  for (std::uint32_t i = 0; i < count; ++i) events.push_back(take_event(reader));
  if (!reader.rest().empty()) throw InputError("bytes are left over after the last event");
  return events;
}

}  // namespace trocar
