// SPDX-License-Identifier: BSD-3-Clause
// npm run build: bundles source/ and Temml into dist/, with its licence on top.
import {build} from 'esbuild';
import {readFileSync} from 'node:fs';

const contains = (name, folder) =>
    `Contains ${name}:\n\n${readFileSync(`node_modules/${folder}/LICENSE`, 'utf8').trim()}\n`;
const banner = `/* SPDX-License-Identifier: BSD-3-Clause AND MIT\n\n` +
    `Built from identify/report/web; do not edit. ${contains('Temml', 'temml')}*/`;

await build({
  entryPoints: {report: 'source/main.js'},
  outdir: 'dist',
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome100', 'firefox100', 'safari15'],
  legalComments: 'none',
  banner: {js: banner, css: banner},
});
