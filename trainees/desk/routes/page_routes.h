// Routes of the pages, by source; desk_routes() gathers them.
#pragma once

#include <functional>
#include <vector>

#include "trainees/desk/routes/route.h"

namespace trocar::review {

std::vector<Route> page_routes();        ///< pages to look at, their pictures and files
std::vector<Route> assessment_routes();  ///< notes, signatures, overrides, certificates
std::vector<Route> film_routes();        ///< films of attempts
std::vector<Route> station_routes();     ///< the live view, messages
std::vector<Route> curriculum_routes();  ///< rules, benchmarks, groups
std::vector<Route> roster_routes();      ///< people, lists of them, cards to sign in with
std::vector<Route> programme_routes();   ///< programmes, assignments, the grid, who is late
std::vector<Route> password_routes();    ///< one's own password
std::vector<Route> admin_routes();       ///< accounts, the record itself, its audit trail, retention, the demo's end

/// What the action answers; a page with the reason where it throws an InputError. @param status of that page.
Response answered(const Request& request, Desk& desk, int status, const std::function<Response()>& action);
Response see(const std::string& location);  ///< 303
/// A table that the browser saves under that name.
Response csv_file(std::string body, const std::string& name);
/// @throws InputError: why the password that was given again does not count.
void require_confirmed(const Request& request);

}  // namespace trocar::review
