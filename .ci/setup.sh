# Shared by ./run and ./test: installs the packages of .ci/packages.txt, configures and builds.

say() { printf '%s\n' "$*" >&2; }

# need_packages FILE SECTION...: installs the packages of these sections that are not there yet.
need_packages() {
  local file=$1 section name condition missing=()
  shift
  while read -r section name condition; do
    case "$section" in '' | '#'*) continue ;; esac
    case " $* " in *" $section "*) ;; *) continue ;; esac
    case "$condition" in unless:*) command -v "${condition#unless:}" >/dev/null 2>&1 && continue ;; esac
    dpkg-query -W -f '${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || missing+=("$name")
  done <"$file"
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
      say "These Debian packages are missing: ${missing[*]}"
      say "Install them as root (apt-get install --no-install-recommends ${missing[*]}) and call again."
      exit 1
    fi
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update &&
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 install -y \
      --no-install-recommends --no-remove "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    say "Installing failed; the whole log is $log"
    exit 1
  fi
  rm -f "$log"
}

# ccache finds a file by the headers the compiler lists, and does not preprocess it a second time; it
# takes precompiled headers (their defines and dates are none of its business: their bytes are).
export CCACHE_DEPEND=1
export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros,include_file_mtime,include_file_ctime}

# configure_and_build ROOT PRESET [TARGET [OPTION...]]: quiet when there is nothing to do. Options are
# of cmake, for a folder that is not configured yet.
configure_and_build() {
  local root=$1 preset=$2 target=${3:-all} log
  shift $(($# < 3 ? $# : 3))
  log="$root/build/$preset.log"
  mkdir -p "$root/build"
  if [ ! -f "$root/build/$preset/build.ninja" ]; then
    say "Configuring ($preset)"
    (cd "$root" && cmake --preset "$preset" "$@") >"$log" 2>&1 || {
      tail -n 30 "$log" >&2
      say "Configuring failed; the whole log is $log"
      exit 1
    }
  fi
  if [ -t 2 ]; then
    (cd "$root" && cmake --build --preset "$preset" --target "$target") >&2 || exit 1
  else
    (cd "$root" && cmake --build --preset "$preset" --target "$target") >"$log" 2>&1 || {
      grep -E -A12 'error|FAILED' "$log" | head -n 60 >&2
      say "The build failed; the whole log is $log"
      exit 1
    }
  fi
}
