#!/bin/bash
# fetch_sources.sh FOLDER PACKAGE...: unpacks sources of Debian packages, as they have no libraries for WebAssembly. The lists of
# this machine's packages stay as they are.
set -eu
folder=$1
shift
mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache" "$folder/apt/parts"
cd "$folder"
# From the archives of Debian that this machine knows, with "deb-src" in place of "deb". They are paragraphs or lines.
for list in /etc/apt/sources.list.d/*.sources; do
    [ ! -f "$list" ] || awk -v RS= -v ORS='\n\n' '/URIs:[^\n]*\/debian\/?[ \n]/ { sub(/Types:[^\n]*/, "Types: deb-src"); print }' "$list" >> apt/parts/debian.sources
done
for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [ ! -f "$list" ] || sed -nE 's/^deb( .*\/debian\/? .*)/deb-src\1/p' "$list" >> apt/parts/debian.list
done
apt=(apt-get -q -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$PWD/apt/parts" -o Dir::State::lists="$PWD/apt/lists"
    -o Dir::Cache="$PWD/apt/cache" -o APT::Sandbox::User=root)
"${apt[@]}" update
for package in "$@"; do
    rm -rf "./$package" "./apt/$package"
    mkdir "apt/$package"
    (cd "apt/$package" && "${apt[@]}" source --download-only "$package" && dpkg-source --no-check --extract ./*.dsc source)
    mv "apt/$package/source" "$package"
done
rm -rf apt
