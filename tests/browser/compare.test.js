// compare.html of a regression: a page without scripts, at a desk, on a phone and in the dark.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { startBrowser, stopBrowser, withPage } from './page.js';

const report = pathToFileURL(process.env.RASTERCHECK_COMPARE).href;
const phone = { report, width: 390, height: 800 };

before(startBrowser);
after(stopBrowser);

test('the verdict, what grew most and where are on the first screen', () => withPage(async (page) => {
  assert.match(await page.locator('h1').textContent(), /^Regression: \d+ of \d+ entries worse/);
  const growth = page.locator('p.finding', { hasText: 'Largest growth' });
  assert.match(await growth.textContent(),
    /pixel \(\d+, \d+\).*[\d.]+ → [\d.]+ scale ULP; the stage to look at is (weights|evaluation)/);
  for (const part of [page.locator('h1'), growth, page.locator('table.worse tbody tr').first()]) {
    const box = await part.boundingBox();
    assert.ok(box.y + box.height < 900, 'below the first screen');
  }
  await growth.getByRole('link').click();
  assert.match(page.url(), /#case-0-0$/);
  assert.ok((await page.locator('#case-0-0').boundingBox()).y < 900);
}, { report }));

test('distributions lie over each other, outlined and filled', () => withPage(async (page) => {
  const overlay = page.locator('.overlay').first();
  await overlay.scrollIntoViewIfNeeded();
  const style = (selector, name) => overlay.locator(selector).first().evaluate(
    (bar, name) => getComputedStyle(bar)[name], name);
  assert.equal(await style('rect.before', 'fill'), 'none');
  assert.notEqual(await style('rect.after', 'fill'), 'none');
  assert.match(await overlay.locator('svg').getAttribute('aria-label'), /in the baseline and .* now/);
  await overlay.locator('summary').click();
  assert.ok(await overlay.locator('table.counts tbody tr').count() > 3);
}, { report }));

/** A part that the baseline kept: its pictures. */
const kept = (page) => page.locator('details:has(figcaption:text-matches("^Old:"))').first();

/** Widths of the pictures of a part, and which pixel of each is painted how often. */
async function look(page) {
  const part = kept(page);
  await part.evaluate((details) => { details.open = true; });
  const pictures = part.locator('svg.crop');
  assert.equal(await pictures.count(), 3);
  assert.deepEqual(await part.locator('figcaption').evaluateAll((all) =>
    all.map((caption) => caption.textContent.split(/[:,]/)[0])), ['Old', 'New', 'Difference']);
  const colours = await pictures.evaluateAll((all) => all.map((picture) =>
    new Set([...picture.querySelectorAll('path:not(.focus):not(.cross)')]
      .map((pixel) => getComputedStyle(pixel).fill)).size));
  assert.ok(colours[2] > 1, 'one colour for all changes');
  const pixels = pictures.last().locator('path:has(title)');
  assert.match(await pixels.first().locator('title').evaluate((title) => title.textContent),
    /^\(\d+, \d+\): (same bits|.* ULP apart|drawn|NaN or infinite)/);
  return Promise.all([0, 1, 2].map((i) => pictures.nth(i).boundingBox()));
}

test('old, new and difference stand side by side', () => withPage(async (page) => {
  const boxes = await look(page);
  assert.equal(new Set(boxes.map((box) => box.y)).size, 1);
  for (const box of boxes) assert.ok(box.width > 200, 'pixels too small to be seen');
}, { report }));

test('a phone has them below each other, and nothing to scroll sideways', () => withPage(async (page) => {
  const boxes = await look(page);
  assert.ok(boxes[0].y < boxes[1].y && boxes[1].y < boxes[2].y);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
}, phone));

test('the dark has a page of its own', () => withPage(async (page) => {
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor),
    'rgb(21, 24, 27)');
  await look(page);
}, { report, options: { colorScheme: 'dark' } }));

test('it has no scripts and is below a megabyte', () => withPage(async (page) => {
  assert.equal(await page.locator('script').count(), 0);
  assert.ok((await page.content()).length < 1e6);
}, { report }));
