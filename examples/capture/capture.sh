#!/bin/sh
# Captures forward with and without its mistakes on lavapipe: forward.jsonl and forward-fixed.jsonl with gfxreconstruct, forward.xml and
# forward-fixed.xml with RenderDoc if it is installed. Arguments: the folder to write to (default: this one), then arguments for forward
# (with --mistake 3, the fixed captures are left out). TOOLS=gfxreconstruct uses only that tool.
#
#     apt install gcc libvulkan-dev mesa-vulkan-drivers gfxreconstruct renderdoc
set -eu
here=$(cd "$(dirname "$0")" && pwd)
to=$(cd "${1:-$here}" && pwd)
[ $# -eq 0 ] || shift

# In a separate folder, because captures contain file names.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${CC:-cc}" -std=c99 -O1 -Wall -Wextra -o "$folder/forward" "$here/forward.c" "$here/device.c" -lvulkan -ldl
cd "$folder"

for driver in /usr/share/vulkan/icd.d/lvp_icd*.json; do
    [ ! -e "$driver" ] || export VK_DRIVER_FILES="$driver" VK_ICD_FILENAMES="$driver"
done

gfxreconstruct() { # NAME, arguments for forward
    name=$1
    shift
    VK_INSTANCE_LAYERS=VK_LAYER_LUNARG_gfxreconstruct GFXRECON_LOG_LEVEL=error GFXRECON_CAPTURE_FILE="$name.gfxr" \
        GFXRECON_CAPTURE_FILE_TIMESTAMP=false ./forward --frames 4 "$@"
    # Version 1 writes one JSON document by default; version 0.9 only writes lines.
    lines=
    ! gfxrecon-convert --help 2>&1 | grep -q -e --format || lines="--format jsonl"
    # shellcheck disable=SC2086
    gfxrecon-convert $lines --output "$name.jsonl" "$name.gfxr"
    cp "$name.gfxr" "$name.jsonl" "$to"
}

renderdoc() { # NAME, arguments for forward
    name=$1
    shift
    renderdoccmd capture --wait-for-exit --working-dir . --capture-file "$name" --opt-ref-all-resources ./forward --frames 1 "$@"
    renderdoccmd convert --filename "${name}_capture.rdc" --output "$name.xml" --convert-format xml
    cp "${name}_capture.rdc" "$to/$name.rdc"
    cp "$name.xml" "$to"
}

for tool in ${TOOLS:-gfxreconstruct renderdoc}; do
    [ $tool = gfxreconstruct ] || command -v renderdoccmd >/dev/null 2>&1 || continue
    $tool forward "$@"
    [ $# -gt 0 ] || $tool forward-fixed --fixed
done
