#!/usr/bin/env bash
# Makes chart.min.js and chart.min.css of view.js and uPlot. Needs node and npm; a build of pirca needs neither, as the result is kept here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here/view.js" "$work"
cd "$work"
npm install --silent --no-save uplot@1.6.32 esbuild@0.28.2
banner='/* uPlot 1.6.32, Copyright 2022 Leon Sorokin, MIT licence (LICENSE-uPlot.txt in the source of pirca) */'
npx esbuild view.js --bundle --minify --format=iife --target=es2020 --legal-comments=none --banner:js="$banner" --outfile=chart.min.js
npx esbuild node_modules/uplot/dist/uPlot.min.css --minify --outfile=chart.min.css
cp chart.min.js chart.min.css "$here"
cp node_modules/uplot/LICENSE "$here/LICENSE-uPlot.txt"
