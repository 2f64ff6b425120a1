#include "tests/structure/include_rules.h"

#include <algorithm>
#include <regex>

#include "tests/structure/source_text.h"

namespace trocar {
namespace {

/// Files whose path matches may include only project headers that match.
struct Direction {
  const char* who;
  const char* may_include;
  const char* rule;
};

/// What the sources that use CGAL share: the one header that shows it, for them alone.
constexpr const char* kCgalMesh = "tissue/mesh/surface/cgal_mesh.h";

/// The simulated device's side of the seam.
constexpr const char* kPlant = "haptics/device/(plant/[a-z_]+|simulated_daq)";

const std::vector<Direction>& directions() {
  static const std::string plant_files = std::string("^") + kPlant + "\\.(h|cpp)$";
  static const std::string plant_sees =
      std::string("^(haptics/quantities\\.h|haptics/device/(data_acquisition|index_mark|simulated_world)\\.h|") +
      kPlant + "\\.h)$";
  static const std::vector<Direction> table{
      {"^haptics/(?!digest/)", "^haptics/(?!digest/)", "haptics depends on nobody"},
      {plant_files.c_str(), plant_sees.c_str(), "the plant shares nothing with the controller but the seam"},
      {"^haptics/device/(data_acquisition|simulated_world)\\.h$", "^haptics/(quantities|fault)\\.h$",
       "the seam brings nothing of the controller along"},
      {"^haptics/quantities\\.h$", "^$", "quantities stand alone"},
      {"^haptics/digest/", "^haptics/(digest/|input_error\\.h$)", "digest stands alone but for the error it throws"},
      {"^tissue/", "^(tissue|haptics)/", "tissue knows haptics only"},
      {"^(?!tissue/mesh/surface/(cgal_mesh|hole_filling|remesh|shrink_wrap|surface_check)\\.)",
       "^(?!tissue/mesh/surface/cgal_mesh\\.h)", "CGAL's mesh stays among the sources that use CGAL"},
      {"^tissue/(collision|rigid|solid)/",
       "^(haptics|tissue/(collision|rigid|solid|mesh|organ|imaging)/|tissue/[a-z_]+\\.h$)",
       "what moves in the scene does not know the files that it came from"},
      {"^tissue/imaging/", "^(haptics/|tissue/(imaging|organ|mesh)/|tissue/progress\\.h$)",
       "images know no lattice and no world"},
      {"^scenarios/", "^(scenarios|tissue|haptics)/", "scenarios know tissue and haptics only"},
      {"^scenarios/scoring/", "^(scenarios/scoring/|haptics/quantities\\.h$)", "scoring is pure"},
      {"^trainees/", "^(trainees|scenarios/scoring|haptics)/", "trainees know scoring and haptics only"},
      {"^trainees/(store|records|integrity|progress)/",
       "^(trainees/(store|records|integrity|progress|files)|scenarios/scoring|haptics)/", "the record knows no desk"},
      {"^trainees/desk/(pages|reports|print)/", "^(?!trainees/desk/(server/desk_server|server/connection))",
       "pages are made without a server"},
      {"^app/(session/(recording|lanes)|picture/(display|gl|models|scene))/",
       "^(app/(session/(recording|lanes|setup/scene\\.h)|picture/(display|gl|models|scene))|"
       "trainees/(files|markup)/|haptics/|tissue/|scenarios/)",
       "parts of the program do not know its commands or the store"},
      {"^app/(session|picture)/", "^(?!app/(cli|window|studies|desk|organs)/)",
       "an attempt and its picture know no command and no window"},
      {"^app/studies/", "^(?!app/(window|desk)/)", "studies know no window and no desk"},
      {"^(app|haptics|tissue|scenarios|trainees)/", "^(app|haptics|tissue|scenarios|trainees)/",
       "no source knows the tests"},
  };
  return table;
}

/// Third-party headers that only files matching `who` may include.
struct Territory {
  const char* header;
  const char* who;
  const char* rule;
};

const std::vector<Territory>& territories() {
  static const std::vector<Territory> table{
      {"^(CGAL|assimp|dcmtk|fcl|gdcm|vtk)/|^(itk|expat)", "^tissue/.*\\.cpp$",
       "geometry and image libraries stay in sources of tissue"},
      {"^sqlite3", "^trainees/.*\\.cpp$", "SQLite stays in sources of trainees"},
      {"^(GL|GLES[23]?|EGL|KHR|epoxy)/|^(ft2build|png)\\.h|^freetype", "^app/picture/.*\\.cpp$",
       "graphics libraries stay in sources of app/picture"},
      {"^CLI/", "^app/(main|(cli|desk|organs|studies|window)/.*)\\.cpp$",
       "command line options stay in sources of commands"},
      {"^toml", "^(scenarios|tissue|trainees/(progress|desk/words)|app/window/(words|attempt))/.*\\.cpp$",
       "TOML is read in sources of scenarios, tissue, progress rules, words and settings"},
      {"^imgui|^GLFW/", "^app/window/.*\\.cpp$", "the window's libraries stay in sources of app/window"},
      {"^AL/", "^app/window/sound/.*\\.cpp$", "OpenAL stays in sources of app/window/sound"},
      {"^httplib", "^trainees/.*\\.cpp$", "the web server stays in sources of trainees"},
      {"^sodium", "^(trainees|haptics/digest)/.*\\.cpp$",
       "cryptography stays in sources of trainees and of the digests"},
      {"^cairo|^pango/|^librsvg/", "^trainees/desk/print/.*\\.cpp$",
       "PDF is written in sources of trainees/desk/print"},
      {"^(pqxx|libpq)", "^trainees/exchange/sync/.*\\.cpp$", "PostgreSQL stays in sources of trainees/exchange/sync"},
      {"^curl/", "^trainees/exchange/lrs/.*\\.cpp$", "the web client stays in sources of trainees/exchange/lrs"},
      {"^hidapi", "^app/window/input/.*\\.cpp$", "HID stays in sources of app/window/input"},
  };
  return table;
}

/// Standard library, POSIX and Eigen: all that a header of the project may show of others.
bool plain(const std::string& name) {
  static const std::regex kPlain(R"(^([a-z_0-9]+|Eigen/[A-Za-z]+)$)");
  return std::regex_search(name, kPlain);
}

bool posix(const std::string& name) {
  static const std::regex kPosix(R"(^(sys/[a-z]+|unistd|fcntl|spawn|signal|dirent|dlfcn|pthread|sched|time)\.h$)");
  return std::regex_search(name, kPosix);
}

/// haptics depends on Eigen and the standard library; any header shows no more than that.
std::string third_party_violation(const std::string& path, const Include& include) {
  if (path.starts_with("tests/")) return "";  // a test may call any library as an oracle
  if (path == kCgalMesh && include.name.starts_with("CGAL/")) return "";
  for (const Territory& territory : territories()) {
    if (std::regex_search(include.name, std::regex(territory.header)) &&
        !std::regex_search(path, std::regex(territory.who))) {
      return territory.rule;
    }
  }
  if (plain(include.name) || posix(include.name)) return "";
  if (path == "haptics/digest/digest.cpp" && include.name.starts_with("openssl/")) return "";
  if (path == "haptics/digest/signature.cpp" && include.name == "sodium.h") return "";
  static const std::regex kLines(R"(^(arpa/inet|netinet/in|poll|termios)\.h$)");  // POSIX, of cards and sensors
  if (std::regex_search(path, std::regex("^haptics/(device/(hostmot2|mc4000)|force_sensor/ati)/.*\\.cpp$")) &&
      std::regex_search(include.name, kLines))
    return "";
  if (path.starts_with("haptics/")) return "haptics includes Eigen and the standard library only";
  if (path.ends_with(".h")) return "only Eigen crosses a header";
  return "";
}

std::string direction_violation(const std::string& path, const Include& include) {
  for (const Direction& direction : directions()) {
    if (std::regex_search(path, std::regex(direction.who)) &&
        !std::regex_search(include.name, std::regex(direction.may_include))) {
      return direction.rule;
    }
  }
  return "";
}

}  // namespace

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex kInclude(R"(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"])", std::regex::multiline);
  std::vector<Include> out;
  const std::string code = blank_literals(text);  // an include inside a comment or a raw string is none
  for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
    const auto at = static_cast<std::size_t>(it->position(1));
    const std::size_t hash = text.rfind('#', at);
    if (code[hash] != '#') continue;
    out.push_back({(*it)[2], (*it)[1] == "<", line_of(text, at)});
  }
  return out;
}

std::vector<std::string> include_violations(const std::string& path, const std::string& text) {
  std::vector<std::string> out;
  for (const Include& include : includes_of(text)) {
    const std::string rule = include.system ? third_party_violation(path, include) : direction_violation(path, include);
    if (rule.empty()) continue;
    out.push_back(path + ":" + std::to_string(include.line) + ": includes " + include.name + ": " + rule);
  }
  return out;
}

}  // namespace trocar
