// Damaged files of every format: each is read or refused, whatever bytes it holds.
//
// Seeded; a number of files of each format, or as many as TROCAR_FUZZ_SECONDS allow.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <random>

#include "haptics/input_error.h"
#include "tests/tissue/mesh/files/scene_writers.h"
#include "tests/tissue/support/temporary_folder.h"
#include "tissue/mesh/surface/topology.h"
#include "tissue/organ/surface_import.h"

namespace trocar::surface_fuzz_test {
namespace {

using namespace test;

struct Seed {
  std::string format;  ///< the extension
  std::vector<std::string> files;
};

TriangleSurface body(double scale) { return scaled(sphere(Vec3(0.02, 0.05, -0.01), 0.04, 1), scale); }

std::vector<Seed> seeds() {
  const TriangleSurface mm = body(1e3);
  const FileTetrahedra solid = star_of(mm);
  const XmlForm plain, zipped{XmlData::kInline, true, false, false}, raw{XmlData::kAppendedRaw, false, true, false},
      letters{XmlData::kAppendedBase64, true, false, true};
  return {
      {"stl", {stl_text(mm), stl_binary(mm), stl_binary(mm, "solid")}},
      {"ply", {ascii_ply(mm, 1)}},
      {"obj", {obj_text(mm)}},
      {"off", {off_text(mm)}},
      {"glb", {glb(gltf_of({{"a", body(1), ""}, {"b", body(0.1), ",\"scale\":[-1,1,1]"}}))}},
      {"gltf",
       {gltf_of({{"a", body(1), ""}}, ",\"uri\":\"data:;base64," + base64(gltf_of({{"a", body(1), ""}}).binary) + "\"")
            .json}},
      {"fbx", {fbx(body(100), fbx_settings(1))}},
      {"vtk",
       {vtk_surface(mm, {}), vtk_surface(mm, {true, true, true, false, "t"}),
        vtk_grid(solid, {true, false, false, true, "t"})}},
      {"vtp", {vtp(mm, plain), vtp(mm, zipped), vtp(mm, raw), vtp(mm, letters)}},
      {"vtu", {vtu(solid, plain), vtu(solid, zipped), vtu(solid, raw), vtu(solid, letters)}},
      {"msh",
       {msh_1(solid.vertices, elements_of(solid)), msh_2(mm.vertices, elements_of(mm), false),
        msh_2(mm.vertices, elements_of(mm), true), msh_4(solid.vertices, elements_of(solid), false),
        msh_4(solid.vertices, elements_of(solid), true)}}};
}

/// Numbers that readers trip over, put where a number was.
const std::array<const char*, 12> kNasty{
    "-1", "0", "4294967295", "2147483648", "1e308", "nan", "-0.0", "18446744073709551615", "3", "9999", "inf", ""};

void damage(std::string& bytes, std::mt19937_64& random) {
  if (bytes.empty()) return;
  const std::size_t at = random() % bytes.size();
  const std::size_t length = std::min<std::size_t>(bytes.size() - at, 1 + random() % 16);
  switch (random() % 8) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(random() % bytes.size(), 64));
      break;
    case 3:
      for (std::size_t n = 0; n < length; ++n) bytes[at + n] = static_cast<char>(random());
      break;
    case 4:
    case 5: {
      const std::size_t first = std::min(bytes.size(), bytes.find_first_of("0123456789-", at));
      const std::size_t last = std::min(bytes.size(), bytes.find_first_not_of("0123456789.-+e", first));
      bytes.replace(first, last - first, kNasty[random() % kNasty.size()]);
      break;
    }
    case 6:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    default:
      bytes.replace(at, length, std::string(length, random() % 2 == 0 ? '\0' : '\xff'));
      break;
  }
}

/// TROCAR_FUZZ_SECONDS for each format; without it a number of files, because a clock is no oracle on a busy machine.
bool enough(std::size_t rounds, std::chrono::steady_clock::time_point begin) {
  constexpr std::size_t kUsual = 40;
  const char* text = std::getenv("TROCAR_FUZZ_SECONDS");
  if (text == nullptr) return rounds >= kUsual;
  return std::chrono::steady_clock::now() - begin >= std::chrono::duration<double>(std::atof(text));
}

SurfaceImportOptions drawn_options(std::mt19937_64& random) {
  SurfaceImportOptions options;
  if (random() % 8 != 0) options.unit = random() % 4 == 0 ? "m" : "mm";
  if (random() % 4 == 0) options.frame = "LAS";
  if (random() % 16 == 0) options.part = "a";
  if (random() % 4 == 0) options.fill_holes_mm = 60;
  if (random() % 64 == 0) options.wrap = WrapSettings{8, 2};
  return options;
}

void expect_sound(const ImportedSurface& imported) {
  const SurfaceTopology facts = analyse_topology(imported.surface);
  EXPECT_TRUE(facts.closed() && facts.manifold());
  EXPECT_EQ(facts.components, 1U);
  EXPECT_GT(imported.surface.volume_m3(), 0);
  for (const auto* list : {&imported.decisions, &imported.repairs, &imported.warnings})
    for (const std::string& sentence : *list)
      for (const char letter : sentence) EXPECT_TRUE(letter >= 32 && letter < 127) << sentence;
}

/// @return whether it was read
bool read_or_refused(const std::filesystem::path& path, std::mt19937_64& random) {
  const SurfaceImportOptions options = drawn_options(random);
  bool read = false;
  try {
    expect_sound(import_surface(path, options));
    read = true;
  } catch (const InputError& error) {
    EXPECT_CONTAINS(error.what(), path.filename().string());
  }
  if (random() % 4 != 0) return read;
  try {
    for (const auto& t : read_tetrahedra(path, options).tetrahedra) EXPECT_GE(*std::min_element(t.begin(), t.end()), 0);
  } catch (const InputError&) {
  }
  return read;
}

class SurfaceFuzz : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SurfaceFuzz, DamagedFilesAreReadOrRefused) {
  TemporaryFolder folder;
  const Seed seed = seeds()[GetParam()];
  std::mt19937_64 random(0xBADF11E + GetParam());
  for (const std::string& file : seed.files) {
    SurfaceImportOptions options;
    options.unit = seed.format == "glb" || seed.format == "gltf" || seed.format == "fbx" ? "" : "mm";
    EXPECT_NO_THROW(import_surface(folder.write("whole." + seed.format, file), options));
  }
  const auto begin = std::chrono::steady_clock::now();
  std::size_t rounds = 0, read = 0;
  for (; !enough(rounds, begin) && !HasFailure(); ++rounds) {
    std::string bytes = seed.files[random() % seed.files.size()];
    for (std::size_t times = 1 + random() % 3; times > 0; --times) damage(bytes, random);
    const auto path = folder.write("damaged." + seed.format, bytes);
    read += read_or_refused(path, random) ? 1 : 0;
    if (HasFailure())
      std::filesystem::copy_file(path, std::filesystem::temp_directory_path() / ("failing." + seed.format),
                                 std::filesystem::copy_options::overwrite_existing);
  }
  std::cout << "  " << seed.format << ": " << rounds << " damaged files, " << read << " still read\n";
  EXPECT_GT(rounds, 10U);
}

INSTANTIATE_TEST_SUITE_P(Formats, SurfaceFuzz, ::testing::Range(std::size_t{0}, std::size_t{11}),
                         [](const auto& drawn) { return seeds()[drawn.param].format; });

}  // namespace
}  // namespace trocar::surface_fuzz_test
