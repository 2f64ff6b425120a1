// Statements of the chosen attempts: read from the database, checked against the standard, written as one JSON array.
// Thread: the Database's.
#pragma once

#include <functional>
#include <iosfwd>

#include "trainees/exchange/export/export_choice.h"
#include "trainees/exchange/export/xapi.h"

namespace trocar {

/// Pass mark 0..100 of the text of an exercise file at a level; empty when it cannot be read.
using PassMark = std::function<std::optional<double>(const std::string& toml, const std::string& level)>;

/// @param row of a finished attempt. @throws InputError: there is none.
XapiAttempt read_xapi_attempt(Database& database, std::int64_t row, const PassMark& pass_mark);

/// What a record store is to know of the chosen attempts and of their people's certificates, in the order in which it
/// is to be told. @throws InputError naming what it is about when a statement breaks the standard.
std::vector<XapiSubject> xapi_subjects(Database& database, const ExportChoice& choice, const XapiSetting& setting,
                                       const PassMark& pass_mark);

/// One statement a line, in an array as a store takes it. @throws InputError naming the attempt when a statement breaks
/// the standard.
void write_xapi(Database& database, const ExportChoice& choice, const XapiSetting& setting, const PassMark& pass_mark,
                std::ostream& out);

/// A launch is one session: the newest chosen attempt. @throws InputError also: attempts of several trainees.
void write_cmi5(Database& database, const ExportChoice& choice, const Cmi5Launch& launch, const PassMark& pass_mark,
                std::ostream& out);

/// Launch data as JSON: {"activityId", "publisherId", "registration", "sessionId", "actor": {"homePage", "name"},
/// "masteryScore"}; the last may be missing. @param name of the file, for messages. @throws InputError.
Cmi5Launch parse_cmi5_launch(const std::string& text, const std::string& name);

}  // namespace trocar
