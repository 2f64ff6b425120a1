#include "app/session/recording/recording_header.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/session/recording/tick_codec.h"
#include "haptics/input_error.h"

namespace trocar {
namespace {

using Json = nlohmann::json;

Json channel_schema() {
  Json channels = Json::array();
  for (const RecordedChannel& channel : recorded_channels()) {
    channels.push_back({{"name", channel.name}, {"unit", channel.unit}, {"quantum", channel.quantum}});
  }
  return channels;
}

/// The program's channels that a recording names, in its order.
std::vector<RecordedChannel> channels_of(const Json& schema) {
  std::vector<RecordedChannel> channels;
  for (const Json& entry : schema) {
    const auto name = entry.at("name").get<std::string>();
    const auto known = std::ranges::find(recorded_channels(), name, &RecordedChannel::name);
    if (known == recorded_channels().end() || entry.at("unit").get<std::string>() != known->unit ||
        entry.at("quantum").get<double>() != known->quantum) {
      throw InputError("its channel '" + name + "' is not one of this program");
    }
    channels.push_back(*known);
  }
  if (channels.empty() || channels.front().name != "tick") throw InputError("its first channel is not 'tick'");
  return channels;
}

void check_rate(double rate_hz) {
  if (!(rate_hz > 0 && rate_hz <= 1e6)) throw InputError("recording: the rate must lie in (0, 1e6] Hz");
}

}  // namespace

std::string encode_header(const RecordingHeader& header) {
  check_rate(header.rate_hz);
  try {
    Json json{{"rate_hz", header.rate_hz}, {"channels", channel_schema()}, {"session", header.session}};
    if (!header.attempt.empty()) json["attempt"] = header.attempt;
    return json.dump();
  } catch (const Json::exception& error) {
    throw InputError(std::string("recording: the header text is not UTF-8: ") + error.what());
  }
}

RecordingHeader decode_header(std::string_view payload) {
  try {
    const Json json = Json::parse(payload);
    RecordingHeader header{json.at("session").get<std::string>(), json.at("rate_hz").get<double>(),
                           json.value("attempt", ""), channels_of(json.at("channels"))};
    check_rate(header.rate_hz);
    return header;
  } catch (const Json::exception& error) {
    throw InputError(std::string("its header is not readable: ") + error.what());
  }
}

}  // namespace trocar
