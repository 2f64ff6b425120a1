// Words of the Experience API and forms of its values. Internal to trainees/exchange/export. Pure.
#pragma once

#include <string_view>

namespace trocar::xapi {

inline constexpr std::string_view kVerbs = "http://adlnet.gov/expapi/verbs/";
inline constexpr std::string_view kSimulation = "http://adlnet.gov/expapi/activities/simulation";
inline constexpr std::string_view kCmi5 = "https://w3id.org/xapi/cmi5/context/";
/// Activities and extensions of Trocar: names, not addresses. They stay what they are whoever runs it.
inline constexpr std::string_view kOwn = "https://trocar.invalid/xapi/";

bool is_uuid(std::string_view text);
/// An absolute IRI: scheme, colon, something; no spaces, controls, <>"{}|\^`.
bool is_iri(std::string_view text);
/// RFC 3339: a day of the calendar, a time, a zone that is not -00, -0000 or -00:00.
bool is_timestamp(std::string_view text);
/// ISO 8601: PnYnMnDTnHnMnS or PnW, a fraction in the last number only.
bool is_duration(std::string_view text);
/// RFC 5646 in outline: letters and digits in parts of at most 8.
bool is_language(std::string_view text);

}  // namespace trocar::xapi
