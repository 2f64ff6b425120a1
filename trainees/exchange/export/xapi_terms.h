// Words of the Experience API and forms of its values. Internal to trainees/exchange/export. Pure.
#pragma once

#include <string>
#include <string_view>

namespace trocar::xapi {

inline constexpr std::string_view kVerbs = "http://adlnet.gov/expapi/verbs/";
inline constexpr std::string_view kSimulation = "http://adlnet.gov/expapi/activities/simulation";
/// Of the registry of verbs and activity types that Tin Can began and record stores know.
inline constexpr std::string_view kEarned = "http://id.tincanapi.com/verb/earned";
inline constexpr std::string_view kCertificate = "http://id.tincanapi.com/activitytype/certificate";
inline constexpr std::string_view kCmi5 = "https://w3id.org/xapi/cmi5/context/";
/// Activities and extensions of Trocar: names, not addresses. They stay what they are whoever runs it.
inline constexpr std::string_view kOwn = "https://trocar.invalid/xapi/";

/// A part of an IRI's path: everything but letters, digits and -._~ as %XX; bytes of UTF-8 stay.
std::string path_part(const std::string& text);

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
