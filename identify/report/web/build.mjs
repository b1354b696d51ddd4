// SPDX-License-Identifier: BSD-3-Clause
// npm run build: bundles source/ and uPlot into dist/, with uPlot's licence on top.
import {build} from 'esbuild';
import {readFileSync} from 'node:fs';

const licence = readFileSync('node_modules/uplot/LICENSE', 'utf8').trim();
const banner = `/* SPDX-License-Identifier: BSD-3-Clause AND MIT\n\n` +
    `Built from identify/report/web; do not edit. Contains uPlot:\n\n${licence}\n*/`;

await build({
  entryPoints: {report: 'source/main.js'},
  outdir: 'dist',
  bundle: true,
  minify: true,
  charset: 'utf8',
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15'],
  legalComments: 'none',
  banner: {js: banner, css: banner},
  // uPlot reads the global devicePixelRatio; see source/pixel_ratio.js.
  define: {devicePixelRatio: 'renderingPixelRatio'},
  inject: ['source/pixel_ratio.js'],
});
