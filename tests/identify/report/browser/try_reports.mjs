// SPDX-License-Identifier: BSD-3-Clause
// try_reports.mjs FOLDER: opens every report in it and does what a reader does.
import assert from 'node:assert/strict';
import {readFileSync, readdirSync, statSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join, resolve} from 'node:path';
import {chromium} from 'playwright-core';

const folder = resolve(process.argv[2]);
const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
const browser = await chromium.launch({
  executablePath: process.env.CATENA_CHROMIUM,
  // A container has no sandbox for it; the rest keeps Chromium from asking the network for its own sake.
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'],
});
let failures = 0;

async function attempt(name, action) {
  try {
    await action();
    console.log(`ok      ${name}`);
  } catch (error) {
    failures += 1;
    console.log(`FAILED  ${name}\n${error.message ?? error}`);
  }
}

/** A page on the report; whatever it complains of or asks of the network is kept. */
async function open(report, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}, colorScheme: 'light', ...options});
  page.complaints = [];
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) page.complaints.push(message.text());
  });
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(`file://${join(folder, report)}.html`);
  return page;
}

/** The frames the script fills; the others have their drawing from the start. */
const frames = 'figure[data-family]:not(:has(.drawing))';

/** Brings every chart into sight once, and stays until it is drawn or taken away (not in this experiment). */
async function seeAll(page) {
  for (const frame of await page.locator(frames).elementHandles()) {
    await frame.evaluate((figure) => figure.scrollIntoView());
    await page.waitForFunction((figure) => figure.hidden || figure.querySelector('.plot canvas'), frame);
  }
  await page.evaluate(() => scrollTo(0, 0));
}

/** Of each chart in sight: pixels in the plot that are neither empty nor grid. */
const inkOfCharts = (page) => page.evaluate(() => {
  const probe = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--grid');
  probe.fillRect(0, 0, 1, 1);
  const grid = probe.getImageData(0, 0, 1, 1).data;
  return [...document.querySelectorAll('figure[data-family]')].filter((f) => !f.hidden && f.querySelector('.plot')).map((figure) => {
    const canvas = figure.querySelector('.uplot canvas');
    const over = figure.querySelector('.u-over');
    const ratio = canvas.width / canvas.clientWidth;
    const area = [over.offsetLeft, over.offsetTop, over.offsetWidth, over.offsetHeight].map((part) => Math.round(part * ratio));
    const scratch = new OffscreenCanvas(area[2], area[3]).getContext('2d', {willReadFrequently: true});
    scratch.drawImage(canvas, ...area, 0, 0, area[2], area[3]);
    const {data} = scratch.getImageData(0, 0, area[2], area[3]);
    let ink = 0;
    for (let k = 0; k < data.length; k += 4) {
      const distance = Math.abs(data[k] - grid[0]) + Math.abs(data[k + 1] - grid[1]) + Math.abs(data[k + 2] - grid[2]);
      if (data[k + 3] > 100 && distance > 40) ink += 1;
    }
    return {family: figure.dataset.family, ink};
  });
});

const picture = (page, selector) => page.locator(selector).first().evaluate((canvas) => canvas.toDataURL());
const clock = async (page) => Number((await page.locator('.clock').textContent()).split(' ')[0]);

async function seriousFindings(page) {
  await page.evaluate(readFileSync(axe, 'utf8'));
  const {violations} = await page.evaluate(() => axe.run());
  return violations.filter((v) => ['serious', 'critical'].includes(v.impact))
      .map((v) => `${v.id}: ${v.help} (${v.nodes.map((n) => n.target).slice(0, 3).join('; ')})`);
}

const reports = readdirSync(folder).filter((name) => name.endsWith('.html')).map((name) => name.slice(0, -5));
assert(reports.length >= 5, 'no reports to try');

for (const report of reports) {
  const page = await open(report);
  await attempt(`${report}: every chart drew data`, async () => {
    await seeAll(page);
    const charts = await inkOfCharts(page);
    assert(charts.length >= 3, `only ${charts.length} charts`);
    assert.equal(charts.length, await page.locator(`${frames}:visible`).count(), 'a frame without its chart');
    assert.deepEqual(charts.filter((chart) => chart.ink < 60), []);
    for (const drawing of await page.locator('.drawing:visible svg').all()) {
      assert((await drawing.locator('path.c1').count()) > 0, 'a drawing without a line');
    }
  });
  await attempt(`${report}: the derived equations are typeset`, async () => {
    const derived = JSON.parse(readFileSync(join(folder, `${report}.json`), 'utf8'));
    const [host, mathematics] = [page.locator('.latex'), page.locator('.latex > math')];
    if (await host.count() > 0) await mathematics.first().waitFor({timeout: 5000});
    assert.equal(await mathematics.count(), await host.count());
    assert.equal(await host.count() > 0, JSON.stringify(derived).includes('"derived"'), 'equations left out');
    assert.equal(await page.locator('.latex mtable mi', {hasText: 'θ'}).count() > 0, await host.count() > 0);
    for (const box of await mathematics.evaluateAll((all) => all.map((one) => one.getBoundingClientRect().height))) {
      assert(box > 25, `${box} px high: not in lines`);
    }
  });
  await attempt(`${report}: themes`, async () => {
    await page.screenshot({path: join(folder, `${report}-light.png`), fullPage: true});
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await paper();
    const chart = await picture(page, '.uplot canvas');
    await page.getByLabel('Theme').selectOption('dark');
    assert.notEqual(await paper(), light);
    assert.notEqual(await picture(page, '.uplot canvas'), chart, 'the chart kept its colours');
    assert.deepEqual((await inkOfCharts(page)).filter((one) => one.ink < 60), []);
    await page.screenshot({path: join(folder, `${report}-dark.png`), fullPage: true});
    assert.deepEqual(await seriousFindings(page), []);
    await page.getByLabel('Theme').selectOption('light');
    assert.equal(await paper(), light);
  });
  await attempt(`${report}: no serious finding of accessibility`, async () => {
    assert.deepEqual(await seriousFindings(page), []);
  });
  await attempt(`${report}: prints`, async () => {
    const file = join(folder, `${report}.pdf`);
    await page.getByLabel('Theme').selectOption('dark');
    await page.pdf({path: file, format: 'A4', printBackground: true});
    const pages = readFileSync(file, 'latin1').match(/\/Type\s*\/Page\b/g) ?? [];
    assert(pages.length >= 2, `${pages.length} pages`);
    assert(statSync(file).size > 50_000, 'too little in it');
    assert.equal(await page.evaluate(() => document.documentElement.dataset.shown), 'dark', 'the theme did not come back');
    await page.getByLabel('Theme').selectOption('light');
  });
  await attempt(`${report}: no complaint, nothing from the network`, async () => {
    assert.deepEqual(page.complaints, []);
  });
  await page.close();
}

await attempt('the test of drawing sees an empty chart', async () => {
  const page = await open('identification');
  await seeAll(page);
  const card = page.locator('#figure-energy');
  for (const button of await card.locator('.legend .series').all()) await button.click();
  const energy = (await inkOfCharts(page)).find((chart) => chart.family === 'energy');
  assert(energy.ink < 60, `${energy.ink} pixels of ink in a chart without series`);
  await page.close();
});

await attempt('player: play, pause, step, scrub, keys, overlaid shapes', async () => {
  const page = await open('identification');
  const first = await picture(page, '#player canvas');
  await page.getByRole('button', {name: 'Play', exact: true}).click();
  await page.waitForFunction(() => parseFloat(document.querySelector('.clock').textContent) > 0.3);
  await page.getByRole('button', {name: 'Pause'}).click();
  const stopped = await clock(page);
  await page.waitForTimeout(200);
  assert.equal(await clock(page), stopped, 'it ran on');
  assert.notEqual(await picture(page, '#player canvas'), first);
  const slider = page.getByLabel('Frame', {exact: true});
  await slider.fill('60');  // 30 frames a second
  assert.equal(await clock(page), 2);
  await page.getByRole('button', {name: '+1 frame'}).click();
  assert.equal(await slider.inputValue(), '61');
  await page.getByRole('button', {name: '−1 frame'}).click();
  await page.keyboard.press('ArrowLeft');
  assert.equal(await slider.inputValue(), '59');
  const plain = await picture(page, '#player canvas');
  await page.getByLabel('Shapes so far').check();
  assert.notEqual(await picture(page, '#player canvas'), plain);
  await page.locator('#player').screenshot({path: join(folder, 'player-shapes.png')});
  await page.getByLabel('Speed').selectOption('4');
  await page.getByRole('button', {name: 'Play', exact: true}).click();
  await page.waitForFunction(() => parseFloat(document.querySelector('.clock').textContent) === 6);
  await page.getByRole('button', {name: 'Play', exact: true}).waitFor();
  assert.deepEqual(page.complaints, []);
  await page.close();
});

await attempt('charts over time zoom together, show values and move the player', async () => {
  const page = await open('identification');
  await seeAll(page);
  const side = page.locator('#figure-position_side');
  await side.scrollIntoViewIfNeeded();
  const other = () => picture(page, '#figure-energy .uplot canvas');
  const frequency = () => picture(page, '#figure-spectrum_side .uplot canvas');
  const [before, spectrum] = [await other(), await frequency()];
  const box = await side.locator('.u-over').boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  assert.match(await side.locator('.value').first().textContent(), /^−?[\d.]+ m$/);
  assert.match(await side.locator('.reading').textContent(), /^time 3(\.\d+)? s$/);
  await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  assert(Math.abs((await clock(page)) - 3) < 0.05, 'a click did not move the player');
  await page.mouse.move(box.x + 0.2 * box.width, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 60, {steps: 5});
  await page.mouse.up();
  assert.notEqual(await other(), before, 'another chart kept its stretch of time');
  assert(Math.abs((await clock(page)) - 3) < 0.05, 'choosing a stretch of time moved the player');
  assert.equal(await frequency(), spectrum, 'a chart over frequency followed');
  await side.screenshot({path: join(folder, 'zoomed.png')});
  await page.getByRole('button', {name: 'Whole time'}).click();
  assert.equal(await other(), before);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

await attempt('heat map: values under the cursor', async () => {
  const page = await open('identification');
  await seeAll(page);
  const map = page.locator('#figure-residual_map');
  await map.scrollIntoViewIfNeeded();
  const box = await map.locator('.u-over').boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + box.height - 4);
  assert.match(await map.locator('.reading').textContent(), /^marker 12, time [\d.]+ s: [\d.]+ mm$/);
  await page.close();
});

await attempt('choices: a point for all charts, another experiment', async () => {
  const page = await open('identification');
  await seeAll(page);
  await page.locator('#figure-position_side').getByLabel('Point').selectOption('marker 12');
  assert.equal(await page.locator('#figure-residuals h3').textContent(), 'Residuals of marker 12');
  const before = await picture(page, '#player canvas');
  await page.locator('#controls').getByLabel('Experiment').selectOption('run 2');
  assert.notEqual(await picture(page, '#player canvas'), before);
  assert.match(await page.locator('.clock').textContent(), /of 3\.00 s$/);
  assert.equal(await page.locator('#figure-residuals h3').textContent(), 'Residuals of marker 12');
  assert.deepEqual(page.complaints, []);
  await page.close();
});

await attempt('60 links, 12 markers, 6 s at 60 Hz: under 5 MB, usable within a second', async () => {
  const size = statSync(join(folder, 'large.html')).size;
  assert(size < 5e6, `${size} bytes`);
  const [wall, work] = [[], []];
  for (let k = 0; k < 5; ++k) {
    const page = await browser.newPage({viewport: {width: 1280, height: 900}});
    const session = await page.context().newCDPSession(page);
    await session.send('Performance.enable', {timeDomain: 'threadTicks'});
    // The script runs before this event: player and controls answer, charts in sight are drawn.
    await page.goto(`file://${join(folder, 'large')}.html`, {waitUntil: 'domcontentloaded'});
    wall.push(await page.evaluate(() => performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd));
    const {metrics} = await session.send('Performance.getMetrics');
    work.push(1000 * metrics.find((one) => one.name === 'TaskDuration').value);
    await page.close();
  }
  const list = (times) => times.map((time) => time.toFixed(0)).join(', ');
  console.log(`        ${(size / 1e6).toFixed(2)} MB; ready after ${list(wall)} ms, ${list(work)} ms of a core`);
  assert(Math.min(...work) > 0);
  assert(Math.min(...work) < 1000);  // other programs may have the rest of a busy machine
});

await attempt('a narrow screen: nothing runs out of the page', async () => {
  const page = await open('identification', {viewport: {width: 390, height: 800}});
  await seeAll(page);
  const [wide, view] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert(wide <= view, `${wide} px in ${view}`);
  await page.screenshot({path: join(folder, 'narrow.png'), fullPage: true});
  await page.close();
});

await browser.close();
console.log(failures === 0 ? 'all passed' : `${failures} failed`);
process.exit(failures === 0 ? 0 : 1);
