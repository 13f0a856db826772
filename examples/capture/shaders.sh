#!/bin/sh
# Generates shaders.h from the shaders in this folder. glslangValidator is in Debian's glslang-tools.
set -eu
cd "$(dirname "$0")"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
{
    echo "// Made by shaders.sh."
    for shader in gear.vert gear.frag composite.vert composite.frag; do
        name=$(echo "$shader" | tr . _)
        glslangValidator -V --quiet --vn "$name" -o "$folder/$name" "$shader"
        sed -n "s/^const/static const/; /$name/,\$p" "$folder/$name"
    done
} >"$folder/shaders.h"
cp "$folder/shaders.h" "${1:-shaders.h}"
