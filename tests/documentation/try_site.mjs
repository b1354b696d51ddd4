// SPDX-License-Identifier: BSD-3-Clause
// try_site.mjs FOLDER: opens the documentation site in it and does what a reader does. Screenshots are left in
// FOLDER/seen.
import assert from 'node:assert/strict';
import {mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
// The packages of the test of reports (scripts/setup_browser).
const packages = createRequire(new URL('../identify/report/browser/package.json', import.meta.url));
const {chromium} = packages('playwright-core');
const axe = packages.resolve('axe-core/axe.min.js');

const folder = resolve(process.argv[2]);
const seen = join(folder, 'seen');
mkdirSync(seen, {recursive: true});
const browser = await chromium.launch({executablePath: process.env.CATENA_CHROMIUM, args: ['--no-sandbox', '--disable-gpu']});
const sizes = {wide: {width: 1280, height: 900}, phone: {width: 390, height: 844}};

async function open(name, size, colorScheme = 'light') {
  const page = await browser.newPage({viewport: sizes[size], colorScheme});
  page.on('pageerror', (error) => assert.fail(`${name}: ${error.message}`));
  page.on('request', (request) => assert.match(request.url(), /^(file|data):/));
  await page.goto(`file://${join(folder, name)}.html`);
  await page.screenshot({path: join(seen, `${name.replace('/', '_')}-${size}-${colorScheme}.png`)});
  return page;
}

for (const name of ['index', 'tutorial', 'case-files', 'checking', 'api/index']) {
  for (const size of Object.keys(sizes)) {
    for (const scheme of ['light', 'dark']) {
      const page = await open(name, size, scheme);
      if (name !== 'api/index') {
        const spill = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(spill <= 0, `${name}, ${size}: ${spill} px wider than the screen`);
        await page.addScriptTag({path: axe});
        const {violations} = await page.evaluate(() => axe.run({runOnly: ['wcag2a', 'wcag2aa']}));
        assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes[0].html}`), [], `${name}, ${size}, ${scheme}`);
        const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
        assert.equal(back[0] < 128, scheme === 'dark', `${name}: background ${back} when ${scheme}`);
      }
      await page.close();
    }
  }
}

const phone = await open('case-files', 'phone');
const menu = () => phone.evaluate(() => document.querySelector('nav').getBoundingClientRect().height / innerHeight);
assert.ok(await menu() < 0.2, `the menu takes ${await menu()} of a phone`);
await phone.click('#menu');
assert.ok(await phone.isVisible('#pages'));
await phone.click('#pages >> text=Glossary');
assert.match(phone.url(), /glossary\.html$/);

// A key of a case file, a word of a message, the beginning of a word: each leads to a place that has it.
for (const [words, place] of [['fit_until', /case-files\.html#experiments$/], ['outlier', /\.html#/],
  ['semisep', /\.html#/], ['lunr', null]]) {
  const page = await open('index', 'wide');
  await page.fill('#search', words);
  if (!place) {
    assert.match(await page.textContent('#found'), /Nothing found/);
    continue;
  }
  const links = await page.$$eval('#found a', (all) => all.map((link) => link.href));
  assert.ok(links.some((link) => place.test(link)), `${words}: ${links}`);
  await page.click('#found a');
  const text = await page.textContent('main');
  assert.ok(text.toLowerCase().includes(words), `${words} is not on ${page.url()}`);
  await page.close();
}

// The main page of the interface leads on.
const api = await open('api/index', 'wide');
const problem = await api.$eval('.contents a:text-is("catena::Problem")', (link) => link.href);
await api.goto(problem);
assert.match(await api.textContent('.contents'), /Throws InputError for/);
await browser.close();
console.log('the site does what a reader asks of it');
