#!/usr/bin/env bash
# Makes solid.min.js of view.js and three.js. Needs node and npm; a build of pirca needs neither, as its result is kept here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here/view.js" "$work"
cd "$work"
npm install --silent --no-save three@0.187.0 esbuild@0.28.2
banner='/* three.js 0.187.0, Copyright 2010-2026 three.js authors, MIT licence (LICENSE-three.txt in the source of pirca) */'
npx esbuild view.js --bundle --minify --format=iife --target=es2020 --legal-comments=none --banner:js="$banner" --outfile=solid.min.js
cp solid.min.js "$here"
cp node_modules/three/LICENSE "$here/LICENSE-three.txt"
