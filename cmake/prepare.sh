# Shared by ./start and ./check (sourced by bash): packages and build. Expects the repository's root as the folder.
# TROCAR_SKIP_INSTALL=1 leaves the machine's packages alone.

say() { printf '\n== %s\n' "$*"; }

# Packages of cmake/debian-packages.txt that dpkg does not know as installed.
missing_packages() {
  local name
  while read -r name; do
    [[ -z $name || $name == \#* ]] && continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null) == installed ]] || printf '%s\n' "$name"
  done < cmake/debian-packages.txt
}

install_missing() {
  if [[ ${TROCAR_SKIP_INSTALL:-0} == 1 ]]; then
    say "TROCAR_SKIP_INSTALL=1: packages are left as they are"
    return
  fi
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "This is no Debian: install what cmake/debian-packages.txt names and set TROCAR_SKIP_INSTALL=1." >&2
    exit 3
  fi
  local -a missing root=()
  mapfile -t missing < <(missing_packages)
  if (( ${#missing[@]} == 0 )); then
    say "Every package of cmake/debian-packages.txt is installed"
    return
  fi
  if (( EUID != 0 )); then
    command -v sudo > /dev/null || { echo "Missing: ${missing[*]}. Install them as root, or install sudo." >&2; exit 3; }
    root=(sudo)
  fi
  say "Installing ${#missing[@]} missing packages: ${missing[*]}"
  "${root[@]}" apt-get update
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}

# build [TARGET...]: configures and builds the release preset.
build() {
  local -a targets=()
  (( $# > 0 )) && targets=(--target "$@")
  say "Configuring (preset release)"
  cmake --preset release
  local jobs
  jobs=$(build_jobs)
  say "Building ${*:-everything} with $jobs jobs"
  cmake --build --preset release --parallel "$jobs" "${targets[@]}"
}

# One a core, and no more than the memory holds: the largest joined source takes 2.2 GB.
build_jobs() {
  local cores gigabytes
  cores=$(nproc)
  gigabytes=$(awk '/MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo)
  local fits=$(( gigabytes * 10 / 24 ))
  echo $(( fits < 1 ? 1 : fits < cores ? fits : cores ))
}
