// Writes every page with its sample data into a folder, to be looked at in a browser: render_pages FOLDER.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>

#include "tests/trainees/desk/pages/page_samples.h"
#include "trainees/desk/assets/assets.h"

namespace fs = std::filesystem;
using namespace trocar::review;

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "render_pages FOLDER\n";
    return 2;
  }
  const fs::path folder = words[1];
  fs::create_directories(folder);
  const auto write = [&](const std::string& name, std::string text) {
    // From a file, the style sheet and script lie beside the page.
    text = std::regex_replace(text, std::regex("\"/(style\\.css|desk\\.js)\""), "\"$1\"");
    text = std::regex_replace(text, std::regex("\"/attempt/[^\"]*picture\\.png\\?t=[0-9.]*\""), "\"picture.png\"");
    std::ofstream(folder / name, std::ios::binary) << text;
  };
  Frame frame = sample_frame();
  write("style.css", style_sheet());
  write("desk.js", desk_script());
  write("cohort.html", cohort_page(sample_cohort(), frame));
  write("trainee.html", trainee_page(sample_trainee(), frame));
  write("attempt.html", attempt_page(sample_attempt(), frame));
  write("compare.html", compare_page(sample_compare(), frame));
  write("curriculum.html", curriculum_page(sample_curriculum(), frame));
  frame.central = {"central.example/trocar", frame.now_utc};
  AttemptView elsewhere = sample_attempt();
  elsewhere.trace.reset();
  elsewhere.picture = false;
  elsewhere.no_trace = "The recording is at station north: without it there are no traces and no pictures here.";
  write("attempt_elsewhere.html", attempt_page(elsewhere, frame));
  frame.central.lost_since_utc = frame.now_utc;
  frame.central.waiting = 2;
  write("cohort_lost.html", cohort_page(sample_cohort(), frame));
  frame.central = {};
  frame.demo = true;
  write("station.html", station_page(sample_stations(), frame));
  write("cohort_empty.html", cohort_page({}, frame));
  return 0;
}
