#include "app/organs/organ_package.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/cli/command.h"
#include "app/organs/zip_writer.h"
#include "app/session/setup/scene.h"
#include "haptics/input_error.h"
#include "tissue/organ/organ.h"
#include "tissue/organ/organ_set.h"
#include "tissue/organ/staged_file.h"

namespace trocar {
namespace {

namespace fs = std::filesystem;

void require_licence(const Organ& organ, const fs::path& manifest) {
  if (!has_licence(organ.licence))
    throw InputError(manifest.string() + ": " + organ.name +
                     " has no licence: it may not be passed on; import it again with --licence when you know it");
}

std::string credit_line(const Organ& organ) {
  return organ.name + (organ.synthetic ? " (synthetic)" : "") + ": made from " + organ.source_file + " (" +
         organ.modality + "), licence " + organ.licence + (organ.credit.empty() ? "" : ", " + organ.credit) + "\n";
}

class Package {
 public:
  void add_organ(const fs::path& path) {
    const Organ organ = load_organ(path);
    require_licence(organ, path);
    const OrganManifest manifest = parse_manifest(read_bytes(path), path.string());
    add_file(path);
    add_file(path.parent_path() / manifest.surface);
    for (const auto& mesh : {manifest.lattice, manifest.tetrahedra})
      if (mesh)
        add_bytes(path.parent_path() / mesh->file,
                  read_unchanged(path.parent_path() / mesh->file, mesh->sha256, path.string()));
    credits_ += credit_line(organ);
  }

  void add_set(const fs::path& path) {
    const OrganSet set = parse_organ_set(read_bytes(path), path.string());
    load_organ(path);  // every member is there and unchanged
    add_file(path);
    for (const std::string& file : set.files) add_organ(path.parent_path() / file);
    for (const std::string& file : set.more_files) add_file(path.parent_path() / file);
  }

  std::string bytes() {
    files_["CREDITS.txt"] = credits_;
    return zip_bytes(files_);
  }
  std::size_t files() const { return files_.size(); }

 private:
  void add_file(const fs::path& path) { add_bytes(path, read_bytes(path)); }

  void add_bytes(const fs::path& path, const std::string& bytes) {
    const auto [place, fresh] = files_.emplace(path.filename().string(), bytes);
    if (!fresh && place->second != bytes)
      throw InputError(path.string() + ": another organ of the package has a different file of this name");
  }

  std::map<std::string, std::string> files_;
  std::string credits_;
};

}  // namespace

bool has_licence(std::string licence) {
  std::erase_if(licence, [](unsigned char letter) { return std::isspace(letter) != 0; });
  for (char& letter : licence) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return !licence.empty() && licence != "unknown" && licence != "none";
}

int organ_package(const OrganPackageOptions& options, std::ostream& out, std::ostream&) {
  if (options.organs.empty()) throw InputError("organ package: no organ was named");
  if (options.output.extension() != ".zip")
    throw InputError(options.output.string() + ": a package is a zip: name it NAME.zip");
  Package package;
  for (const std::string& name : options.organs) {
    const fs::path path = without_subject(find_organ(name, options.assets));
    if (path.string().ends_with(kOrganSetSuffix))
      package.add_set(path);
    else
      package.add_organ(path);
  }
  StagedFile file(options.output, package.bytes());
  file.commit();
  out << options.output.string() << ": " << package.files() << " files, each with a licence\n";
  return 0;
}

void add_organ_package(CLI::App& parent, CommandAction& chosen) {
  const auto given = std::make_shared<OrganPackageOptions>();
  OrganPackageOptions& o = *given;
  CLI::App* package =
      add_command(parent, "package", "Organs with a licence, and their credits, as a zip to pass on", chosen, [given] {
        given->assets = find_assets().assets;
        return organ_package(*given, std::cout, std::cerr);
      });
  package->add_option("organs", o.organs, "NAME.organ.toml, NAME.scene.toml or shipped organs")->required();
  package->add_option("-o,--output", o.output, "FILE.zip")->required()->check(writable_path());
}

}  // namespace trocar
