// The page of a judged picture: first-triangle.json of the corpus, drawn affinely.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { factsOf, startBrowser, stopBrowser, titleOf, withPage } from './page.js';

const report = pathToFileURL(process.env.RASTERCHECK_JUDGED).href;

before(startBrowser);
after(stopBrowser);

const frameOf = (page) => page.locator('.frame').first();

/** Points at the middle of a pixel of the 8×8 picture. */
async function pointAt(page, x, y, act = 'move') {
  await frameOf(page).scrollIntoViewIfNeeded();
  const plot = await page.locator('.picture rect.plot').first().boundingBox();
  const place = [plot.x + (x + 0.5) * (plot.width / 8), plot.y + (y + 0.5) * (plot.height / 8)];
  if (act === 'click') await page.mouse.click(...place);
  else await page.mouse.move(...place);
}

async function choose(page, name) {
  await page.locator('.views label', { hasText: new RegExp(`^${name}$`) }).click();
}

test('verdict, farthest pixel, kinds, contract and next step are on the first screen', () =>
  withPage(async (page) => {
    assert.match(await page.locator('h1').textContent(), /^Wrong: \d+ of 64 pixels$/);
    const farthest = page.locator('p.finding');
    assert.match(await farthest.textContent(),
      /^Farthest off is pixel \(\d, \d\), wrong value: Y was drawn as [\d.]+ and must be [\d.]+/);
    const parts = [farthest, page.locator('table.kinds'), page.locator('aside h2'),
      page.locator('dl.next')];
    for (const part of parts) {
      const box = await part.boundingBox();
      assert.ok(box.y + box.height < 900, 'below the first screen');
    }
    assert.match(await page.locator('aside').textContent(), /what the case asks for.*exactly where/s);
    assert.match(await page.locator('dl.next').textContent(),
      /rastercheck explain \S+first-triangle.json --backend cpu --pixel \d,\d --triangle 0/);
  }, { report }));

test('pictures are enlarged without smoothing', () => withPage(async (page) => {
  const pictures = page.locator('.whole img');
  assert.equal(await pictures.count(), 3);
  for (const picture of await pictures.all()) {
    assert.ok((await picture.boundingBox()).width > 200);
    assert.equal(await picture.evaluate((img) => getComputedStyle(img).imageRendering), 'pixelated');
    assert.equal(await picture.evaluate((img) => img.naturalWidth), 8);
  }
}, { report }));

test('pointing and keys tell of a pixel, and pinning stays there', () => withPage(async (page) => {
  await pointAt(page, 0, 0);
  assert.match(await titleOf(page), /^Pixel \(0, 0\)/);
  assert.match(await page.locator('.panel .outcome').textContent(), /^right/);
  await pointAt(page, 2, 3, 'click');
  assert.match(await titleOf(page), /^Pixel \(2, 3\).*pinned/);
  assert.match(await page.locator('.panel .outcome').textContent(), /^wrong value/);
  assert.match(await page.locator('.panel .faults').textContent(),
    /^Y was drawn as [\d.]+ and must be [\d.]+ to [\d.]+$/);
  assert.match((await factsOf(page))['Y ✗'], /^[\d.]+/);
  assert.equal(await page.locator('.panel .answer h5').first().textContent(), 'triangle 0');
  await pointAt(page, 0, 0);
  assert.match(await titleOf(page), /^Pixel \(2, 3\)/);
  await frameOf(page).focus();
  for (const key of ['Escape', 'ArrowRight', 'ArrowUp']) await page.keyboard.press(key);
  assert.match(await titleOf(page), /^Pixel \(3, 2\).*pinned/);
  assert.match(await page.locator('.spoken').textContent(),
    /^Pixel 3, 2: wrong value, Y was drawn as [\d.]+ and must be/);
  assert.match(await page.locator('.panel .explain').textContent(), /--pixel 3,2 --triangle 0$/);
}, { report }));

test('each view has its picture and its legend', () => withPage(async (page) => {
  const legend = () => page.locator('.legend').textContent();
  assert.match(await legend(), /wrong value: in a colour of no triangle.*the pixel in question/);
  await choose(page, 'Difference');
  assert.match(await legend(), /steps beyond what is permitted.*≤ 64.*above.*below/);
  for (const view of ['Picture', 'Permitted', 'Drawn', 'Compare', 'Difference']) {
    await choose(page, view);
    assert.ok(await page.locator('.picture g > rect').count() >= 64, view);
  }
  assert.equal(await page.locator('.picture .outline').count(), 1);
}, { report }));

test('an address opens the same pixel again', () => withPage(async (page) => {
  assert.match(await titleOf(page), /^Pixel \(1, 4\).*pinned/);
  assert.equal(await page.locator('.views input:checked').getAttribute('value'), 'difference');
}, { report, hash: '#inspection=0&x=1&y=4&sample=0&view=difference' }));

test('a phone has nothing to scroll sideways, and the dark has a page of its own', () =>
  withPage(async (page) => {
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor),
      'rgb(21, 24, 27)');
    await pointAt(page, 2, 3);
    assert.match(await titleOf(page), /^Pixel \(2, 3\)/);
  }, { report, width: 390, height: 800, options: { colorScheme: 'dark' } }));
