#!/usr/bin/env bash
# Prints the folder to put on PATH for an Emscripten >= MIN, installing a private one if there is none.
#
#   export PATH="$(scripts/install-emscripten.sh):$PATH"
#   scripts/install-emscripten.sh [PREFIX]          (default: <repository>/.toolchain/emscripten)
#
# An emcc already on PATH that is new enough (from emsdk or a newer distribution) is used.
# Otherwise the script downloads the packages of one Debian release from this machine's apt mirror.
# apt checks them against the signed index. They are unpacked under PREFIX with their own C library:
# this needs no root, and leaves the system and its apt sources unchanged. Another run does nothing,
# and an interrupted run resumes. After moving PREFIX, run the script again.
#
#   EMSCRIPTEN_PRIVATE=1    ignore an emcc on PATH
#   EMSCRIPTEN_KEEP_DEBS=1  keep the downloaded packages
#   EMSCRIPTEN_MIRROR=URL   Debian mirror to use if apt is configured for none
set -euo pipefail

MIN=3.1.69
SUITE=trixie
KEYRING=/usr/share/keyrings/debian-archive-keyring.gpg
# The compiler is pinned to an upstream version; the * permits a rebuild of it. Its libraries have
# the versions of the release's signed index.
PACKAGES=(
  'emscripten=3.1.69+*' 'binaryen=120-*' 'clang-19=1:19.1.7-*' 'lld-19=1:19.1.7-*' 'llvm-19=1:19.1.7-*'
  'libllvm19=1:19.1.7-*' 'libclang-cpp19=1:19.1.7-*' 'libclang-common-19-dev=1:19.1.7-*'
  'libglm-dev=0.9.9.8+*' node-acorn patchelf
  libc6 libstdc++6 libgcc-s1 zlib1g libzstd1 libxml2 liblzma5 libedit2 libbsd0 libmd0 libffi8 libtinfo6 libz3-4
)
# Files to leave out, mostly prebuilt system libraries (1.2 of 1.6 GB); EM_FROZEN_CACHE=0 builds one when needed.
LEAVE_OUT=(
  './usr/share/doc' './usr/share/man' './usr/share/emscripten/test' './usr/share/z3' '*/llvm-exegesis'
  '*/wasm32-emscripten/pic' '*/wasm32-emscripten/lto-pic' '*/wasm32-emscripten/*-ww*'
  '*/wasm32-emscripten/*libwasmfs-*' '*/wasm32-emscripten/*-tracing*' '*/wasm32-emscripten/*memvalidate*'
  '*/wasm32-emscripten/*verbose*' '*/wasm32-emscripten/*GL-*emu*' '*/wasm32-emscripten/lto/*san*'
)

say() { printf 'emscripten: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }
version_of() { "$1" --version 2>/dev/null | sed -n '1s/.* \([0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*\).*/\1/p'; }
at_least() { [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]; }   # at_least LOW HIGH

if [ -z "${EMSCRIPTEN_PRIVATE:-}" ] && emcc=$(command -v emcc); then
  found=$(version_of "$emcc" || true)
  if [ -n "$found" ] && at_least "$MIN" "$found"; then
    say "using $found from PATH"; dirname "$emcc"; exit 0
  fi
  say "emcc on PATH is ${found:-broken}, older than $MIN: using a private one"
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(git -C "$here" rev-parse --show-toplevel 2>/dev/null || dirname "$here")
prefix=$(realpath -m "${1:-$top/.toolchain/emscripten}")
root=$prefix/root part=$prefix/part debs=$prefix/debs state=$prefix/apt
bin=$root/usr/share/emscripten
stamp="$prefix $SUITE $(printf '%s|' "${PACKAGES[@]}" "${LEAVE_OUT[@]}" | cksum)"
ready() { [ -x "$bin/emcc" ] && [ "$(cat "$prefix/stamp" 2>/dev/null)" = "$stamp" ]; }

ready && { echo "$bin"; exit 0; }
for tool in apt-get dpkg-deb python3 tar flock; do
  command -v "$tool" >/dev/null || die "no $tool here: install emsdk (emscripten.org) and put its emcc on PATH"
done
node=$(command -v node) || die "node is needed (16 or later)"
mkdir -p "$debs" "$state/lists/partial" "$state/cache/archives/partial"
exec 9>"$prefix/lock"; flock 9
ready && { echo "$bin"; exit 0; }

# Use apt with separate sources, lists and an empty status; the system's configuration is only read for the mirror.
mirror=${EMSCRIPTEN_MIRROR:-$(apt-get update --print-uris 2>/dev/null | sed -nE \
  "s#^'(.*)/dists/(bullseye|bookworm|trixie|forky|duke|sid|stable|testing|unstable)(-updates)?/(In)?Release'.*#\1#p" | sed -n 1p)}
[ -n "$mirror" ] || die "apt is configured for no Debian mirror: set EMSCRIPTEN_MIRROR, or use emsdk"
signed=''; [ -r "$KEYRING" ] && signed="[signed-by=$KEYRING] "
echo "deb $signed$mirror $SUITE main" >"$state/sources.list"
: >"$state/status"
cat >"$state/apt.conf" <<CONF
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
#clear Acquire::IndexTargets::deb::DEP-11;
Dir::Etc::sourcelist "$state/sources.list";
Dir::Etc::sourceparts "/dev/null";
Dir::Etc::preferences "/dev/null";
Dir::Etc::preferencesparts "/dev/null";
Dir::State::Lists "$state/lists";
Dir::State::status "$state/status";
Dir::Cache "$state/cache";
APT::Sandbox::User "";
APT::Default-Release "";
Acquire::Languages "none";
Acquire::AllowInsecureRepositories "false";
Acquire::AllowWeakRepositories "false";
APT::Get::AllowUnauthenticated "false";
Acquire::Retries "3";
CONF
ours() { apt-get -qq -c "$state/apt.conf" "$@" >&2; }
say "reading the package index of $SUITE"
ours update || die "no verified index of $SUITE (a keyring without its key? install a newer debian-archive-keyring)"
say "fetching ${#PACKAGES[@]} packages (about 320 MB; what is there already is kept)"
(cd "$debs" && ours download "${PACKAGES[@]}") || die "download incomplete: run this again to resume"

# Also packages of an earlier run, which may have been interrupted: each must be the one of the signed index.
say "checking the packages"
for package in "${PACKAGES[@]%%=*}"; do
  file=$(ls -t "$debs/${package}"_*.deb | head -n 1)
  version=$(dpkg-deb -f "$file" Version)
  expected=$(apt-cache -c "$state/apt.conf" show "$package=$version" | sed -n 's/^SHA256: //p' | sort -u)
  found=$(sha256sum "$file" | cut -d ' ' -f 1)
  if [ -z "$expected" ] || ! grep -qx "$found" <<<"$expected"; then
    mv "$file" "$file.refused"
    die "$(basename "$file") has the SHA-256 $found, not ${expected:-one of the signed index}: it is not used; run this again"
  fi
done

say "unpacking"
rm -rf "$part"; mkdir "$part"
for package in "${PACKAGES[@]%%=*}"; do
  file=$(ls -t "$debs/${package}"_*.deb | head -n 1)
  sha256sum "$file" | sed "s# .*/#  #" >>"$part/MANIFEST"
  dpkg-deb --fsys-tarfile "$file" | tar -x -C "$part" --no-same-owner "${LEAVE_OUT[@]/#/--exclude=}"
done

# Make the programs use our loader and libraries. DT_RPATH takes precedence over LD_LIBRARY_PATH and also applies to the
# dependencies of the libraries.
loader=$(cd "$part" && find usr/lib -name 'ld-linux*.so.*' -type f | head -n 1)
libs=${loader%/*}
patchelf() { "$part/$loader" --library-path "$part/$libs" "$part/usr/bin/patchelf" "$@"; }
is_elf() { [ -f "$1" ] && [ ! -L "$1" ] && [ "$(head -c 4 "$1" | tr -d '\0')" = $'\x7fELF' ]; }
for file in "$part/$libs"/lib{LLVM,clang-cpp,binaryen}*.so*; do
  if is_elf "$file"; then patchelf --force-rpath --set-rpath "\$ORIGIN" "$file"; fi
done
for file in "$part"/usr/lib/llvm-*/bin/* "$part"/usr/bin/wasm*; do
  if is_elf "$file"; then
    patchelf --set-interpreter "$root/$loader" "$file"
    patchelf --force-rpath --set-rpath "\$ORIGIN/$(realpath -m --relative-to="${file%/*}" "$part/$libs")" "$file"
  fi
done

# Configure the paths of Emscripten's tools and cache. Link acorn where every Node finds it: ES imports ignore NODE_PATH.
llvm=$(cd "$part" && echo usr/lib/llvm-*/bin)
mkdir -p "$part/usr/share/emscripten/node_modules"
ln -s ../../nodejs/acorn "$part/usr/share/emscripten/node_modules/acorn"
cat >"$part/usr/share/emscripten/.emscripten" <<CONF
import shutil
LLVM_ROOT = '$root/$llvm'
BINARYEN_ROOT = '$root/usr'
NODE_JS = shutil.which('node') or '$node'
CACHE = '$bin/cache'
FROZEN_CACHE = True
CONF
rm -rf "$root"; mv "$part" "$root"

say "checking"
for file in "$root/$llvm"/{clang,wasm-ld,llvm-ar,llvm-nm,llvm-objcopy} "$root"/usr/bin/wasm-{opt,metadce,emscripten-finalize}; do
  outside=$(LD_TRACE_LOADED_OBJECTS=1 "$file" | grep '=>' | grep -vF "=> $root/" || true)
  [ -z "$outside" ] || die "$(basename "$file") does not find its libraries in $root: $outside"
done
# Emscripten's .js files are CommonJS, even if a package.json in a parent folder declares ES modules.
echo '{ "type": "commonjs" }' >"$prefix/package.json"
mkdir -p "$prefix/try"
echo 'int main() { return 0; }' >"$prefix/try/a.c"
env -u EM_CONFIG "$bin/emcc" "$prefix/try/a.c" -o "$prefix/try/a.js" >&2 && "$node" "$prefix/try/a.js" || die "the self-test failed"
rm -rf "$prefix/try" "$state"; [ -n "${EMSCRIPTEN_KEEP_DEBS:-}" ] || rm -rf "$debs"
printf '%s\n' "$stamp" >"$prefix/stamp"
say "$(version_of "$bin/emcc") ready in $prefix"
echo "$bin"
