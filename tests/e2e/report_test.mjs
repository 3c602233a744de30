// Opens reports in a headless Chromium and clicks through them.
// usage: node report_test.mjs CAIRN MAKE_RUN
// Exit code 77 (skipped) where Chromium or playwright-core is missing, or the program was built without the page.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [cairn, makeRun] = process.argv.slice(2);
const require = createRequire(new URL('../../web/package.json', import.meta.url));

function skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

function loadPlaywright() {
  try {
    return require('playwright-core').chromium;
  } catch {
    return skip('playwright-core is not in web/node_modules (npm ci in web/)');
  }
}

function findChromium() {
  const candidates = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
  return candidates.find((path) => path && existsSync(path)) ?? skip('no Chromium (apt install chromium)');
}

const folder = mkdtempSync(join(tmpdir(), 'cairn_e2e_'));

function makeReport(kind) {
  const directory = join(folder, kind);
  assert.equal(spawnSync(makeRun, [kind, directory], { stdio: 'inherit' }).status, 0);
  const report = spawnSync(cairn, ['report', directory], { encoding: 'utf8' });
  if (report.stderr.includes('no report page')) skip(report.stderr.trim());
  assert.equal(report.status, 0, report.stderr);
  return pathToFileURL(join(directory, 'report.html')).href;
}

// A page that must neither ask the network for anything nor complain.
async function open(browser, kind, options = {}) {
  const url = makeReport(kind);
  const page = await browser.newPage({ viewport: { width: 1400, height: 1000 }, ...options });
  page.setDefaultTimeout(90_000);  // busy machines are slow, not wrong
  page.complaints = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) page.complaints.push(message.text()); });
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('request', (request) => { if (!/^(file|data):/.test(request.url())) page.complaints.push(`asked for ${request.url()}`); });
  await page.goto(url);
  await page.waitForSelector('html[data-ready=yes][data-map=drawn]', { state: 'attached' });
  await addPixelReader(page);
  return page;
}

// Pixels are read from a copy: reading a page's own canvas makes the browser warn.
const addPixelReader = (page) => page.evaluate(() => {
  window.pixelsOf = (canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height).data;
  };
});

// Number of different colours in each canvas: a blank one has one.
const colorsOfCanvases = (page) => page.$$eval('canvas', (canvases) =>
  canvases.map((canvas) => new Set(new Uint32Array(window.pixelsOf(canvas).buffer)).size));

const brightness = (page) => page.$eval('.map-frame canvas', (canvas) => {
  const pixels = window.pixelsOf(canvas);
  return pixels.reduce((sum, value, i) => sum + (i % 4 === 0 ? value : 0), 0) / (pixels.length / 4);
});

const picture = (page) => page.$eval('.map-frame canvas', (canvas) => canvas.toDataURL());
const nextFrame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const clock = (page) => page.textContent('#clock');
const titles = (page) => page.$$eval('h2', (all) => all.map((h2) => h2.firstChild.textContent));

async function setTime(page, seconds) {
  await page.$eval('#time', (slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
  }, seconds);
  await nextFrame(page);
}

async function everythingIsDrawn(page) {
  const colors = await colorsOfCanvases(page);
  assert.ok(colors.length >= 12, `${colors.length} canvases`);
  colors.forEach((n, i) => assert.ok(n > 5, `canvas ${i} is blank (${n} colours)`));
  const expected = ['Map', 'Position error', 'Heading error', 'Uncertainty (1σ of the estimate)',
    'Particles and effective sample size', 'Hypotheses', 'Distribution of the position error', 'Outcomes per stream', 'Timings'];
  const found = await titles(page);
  for (const title of expected) assert.ok(found.includes(title), `${title} is missing`);
  assert.match(await page.textContent('#tiles'), /Mean position error2\.74 cm/);
  assert.match(await page.textContent('#verdict'), /tracking/);
}

async function sliderMovesTheInstant(page) {
  await setTime(page, 100);
  assert.match(await clock(page), /^100\.0 s/);
  const before = { picture: await picture(page), readout: await page.textContent('#readout') };
  const cursor = () => page.$eval('.cursor', (element) => element.style.transform);
  const left = await cursor();
  await setTime(page, 200);
  assert.match(await clock(page), /^200\.0 s/);
  assert.notEqual(await picture(page), before.picture, 'the map did not change with the slider');
  assert.notEqual(await page.textContent('#readout'), before.readout);
  assert.notEqual(await cursor(), left, 'the line in the charts did not move');
}

async function chartClickMovesTheInstant(page) {
  const chart = page.locator('.chart').first();
  const { width } = await chart.boundingBox();
  await chart.click({ position: { x: 64 + (width - 84) / 2, y: 100 } });
  assert.match(await clock(page), /^1(49|50)\./);
}

async function playRunsAndPauses(page) {
  await setTime(page, 10);
  await page.click('#play');
  assert.match(await page.textContent('#play'), /Pause/);
  await page.waitForFunction(() => parseFloat(document.querySelector('#clock').textContent) > 11);
  await page.click('#play');
  const stopped = await clock(page);
  await page.waitForTimeout(200);
  assert.equal(await clock(page), stopped, 'still playing after a pause');
}

async function playStopsAtTheEnd(page) {
  await setTime(page, 299);
  await page.click('#play');
  await page.waitForFunction(() => document.querySelector('#play').textContent.includes('Play'));
  assert.match(await clock(page), /^300\.0 s/);
}

async function layersSwitch(page) {
  await setTime(page, 120);
  for (const layer of ['map', 'reference', 'estimate', 'particles', 'ellipse']) {
    await page.click('button[title="show all"]');
    for (let i = 0; i < 8; ++i) await page.click('button[title="zoom in"]');  // small things must show
    await nextFrame(page);
    const near = () => page.$eval('canvas.close-up', (canvas) => canvas.toDataURL());
    const before = await near();
    await page.uncheck(`[data-layer=${layer}]`);
    await nextFrame(page);
    assert.notEqual(await near(), before, `switching ${layer} off changed nothing`);
    await page.check(`[data-layer=${layer}]`);
    await nextFrame(page);
    assert.equal(await near(), before, `switching ${layer} on again did not restore the picture`);
  }
}

async function colorsAndZoomChange(page) {
  await page.click('button[title="show all"]');
  await nextFrame(page);
  const seen = new Set();
  for (const key of ['error', 'uncertainty', 'quality', 'plain']) {
    await page.selectOption('#color-by', key);
    await nextFrame(page);
    seen.add(await picture(page));
  }
  assert.equal(seen.size, 4, 'two colourings look alike');
  const all = await picture(page);
  await page.click('button[title="zoom in"]');
  await nextFrame(page);
  assert.notEqual(await picture(page), all);
}

// The wall at the upper left corner of the office, (0.1, 13.9), must be dark where the camera says it is.
async function mapLiesInPlace(page, yaw) {
  await page.click('button[title="show all"]');
  await setTime(page, 0);
  const corner = [0.1 * Math.cos(yaw) - 13.9 * Math.sin(yaw), 0.1 * Math.sin(yaw) + 13.9 * Math.cos(yaw)];
  const frame = await page.locator('.map-frame canvas').boundingBox();
  await page.evaluate(() => scrollTo(0, 0));
  const place = async (px, py) => {
    await page.locator('.map-frame canvas').hover({ position: { x: px, y: py } });
    return (await page.textContent('.where')).match(/-?[\d.]+/g).map(Number);
  };
  const [a, b] = [await place(200, 200), await place(400, 400)];
  const at = (axis) => 200 + 200 * (corner[axis] - a[axis]) / (b[axis] - a[axis]);
  const [px, py] = [at(0), at(1)];
  assert.ok(px > 0 && py > 0 && px < frame.width && py < frame.height, `the corner is outside, at ${px}, ${py}`);
  const grey = await page.$eval('.map-frame canvas', (canvas, [x, y]) =>
    window.pixelsOf(canvas)[4 * (Math.round(y * devicePixelRatio) * canvas.width + Math.round(x * devicePixelRatio))], [px, py]);
  assert.ok(grey < 120, `no wall at the corner (grey ${grey} at ${px}, ${py})`);
}

async function colorsFollowTheSystem(page) {
  assert.ok(await brightness(page) > 180);
  await page.emulateMedia({ colorScheme: 'dark' });
  await nextFrame(page);
  assert.ok(await brightness(page) < 100, 'the map is not dark');
  (await colorsOfCanvases(page)).forEach((n, i) => assert.ok(n > 5, `canvas ${i} is blank in the dark`));
}

// On paper everything is light and as wide as the page.
async function printsOnPaper(page) {
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  assert.ok(await brightness(page) > 180, 'the map is printed dark');
  const widths = await page.$$eval('canvas', (all) => all.map((canvas) => canvas.getBoundingClientRect().right));
  assert.ok(Math.max(...widths) < 1060, 'a chart is wider than the page');
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.ok(await brightness(page) < 100, 'the page did not return from printing');
}

async function fullRun(browser) {
  const page = await open(browser, 'full');
  await everythingIsDrawn(page);
  await mapLiesInPlace(page, 0);
  await sliderMovesTheInstant(page);
  await chartClickMovesTheInstant(page);
  await playRunsAndPauses(page);
  await playStopsAtTheEnd(page);
  await layersSwitch(page);
  await colorsAndZoomChange(page);
  await colorsFollowTheSystem(page);
  await printsOnPaper(page);
  assert.deepEqual(page.complaints, []);
}

async function withoutReference(browser) {
  const page = await open(browser, 'no_reference');
  assert.match(await page.textContent('#no-errors'), /no reference trajectory/);
  assert.ok(!(await titles(page)).some((title) => title.includes('error')));
  assert.equal(await page.locator('[data-layer=reference]').count(), 0);
  await sliderMovesTheInstant(page);
  assert.deepEqual(page.complaints, []);
}

async function hostileNames(browser) {
  const page = await open(browser, 'hostile');
  await everythingIsDrawn(page);
  await mapLiesInPlace(page, 0.35);
  for (const chart of await page.locator('.chart').all()) await chart.hover();  // tool-tips show the names as well
  const attacked = await page.evaluate(() => [window.attacked, document.querySelectorAll('img').length]);
  assert.deepEqual(attacked, [undefined, 0]);
  assert.match(await page.title(), /onerror/);
  assert.match(await page.textContent('#configuration'), /<\/script><img src=x/);
  assert.deepEqual(page.complaints, []);
}

async function bareRun(browser) {
  const page = await open(browser, 'bare');
  assert.match(await page.textContent('#configuration'), /Configuration/);
  assert.match(await page.textContent('.map-missing'), /no map/);
  assert.deepEqual(page.complaints, []);
}

const chromium = loadPlaywright();
const browser = await chromium.launch({
  executablePath: findChromium(),
  args: ['--no-sandbox', '--disable-gpu', '--disable-background-networking'],
});
try {
  for (const test of [fullRun, withoutReference, hostileNames, bareRun]) {
    await test(browser);
    console.log(`ok: ${test.name}`);
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
