// The report of one attempt: a single HTML page with inline style and SVG, no script, no request to anywhere.
//
// Order: verdict and the one main reason, sub-scores (safety first, time last), force against time, stiffness beside
// K_max, tip path, events, metrics, device receipt, origin of the organ, hashes. Prints on A4. Same input, same bytes.
// Thread: any.
#pragma once

#include <filesystem>
#include <string>

#include "app/report/board_plots.h"
#include "scenarios/scoring/attempt_result.h"
#include "trainees/markup/plots.h"

namespace trocar {

struct ReportContext {
  std::string exercise_number;     ///< "E02"
  std::string exercise_title;      ///< "Surface touch"
  std::string goal;                ///< one line
  ForceLimits band;                ///< N
  PoseLimits pose;                 ///< pens: their errors take the force plot's place
  std::vector<GripLimits> blocks;  ///< foam blocks: the grip on each takes the force plot's place
  double pass_mark = 75;           ///< 0..100
  double time_limit_s = 0;         ///< 0: none
  std::filesystem::path picture;   ///< PNG of the attempt; empty: none
  bool embed_picture = true;       ///< into the page (base64); false: relative link by file name
  std::string program_version;     ///< "0.1.0"
};

/// The whole page as UTF-8 text.
/// @throws EnvironmentError when the picture is to be embedded and cannot be read.
std::string report_page(const AttemptResult& result, const Trace& trace, const ReportContext& context);

/// Writes report_page to a file.
/// @throws EnvironmentError naming the file when it cannot be written.
void write_report(const std::filesystem::path& path_html, const AttemptResult& result, const Trace& trace,
                  const ReportContext& context);

}  // namespace trocar
