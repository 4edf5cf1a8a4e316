// The viewer of an inspection: what it shows by mouse, by keys, by link. Expected numbers are of the
// triangle in tests/reports/sample_inspections.h: u at pixel (3, 4) is 97/70, drawn five units of
// 2^-22 and a quarter above.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { factsOf, startBrowser, stopBrowser, titleOf, until, withPage } from './page.js';

before(startBrowser);
after(stopBrowser);

const frameOf = (page) => page.locator('details[open] .frame').first();

/** Points at the middle of a pixel of the 8×8 part. */
async function pointAt(page, x, y, act = 'move') {
  const plot = await page.locator('details[open] .picture rect.plot').first().boundingBox();
  const place = [plot.x + (x + 0.5) * (plot.width / 8), plot.y + (y + 0.5) * (plot.height / 8)];
  if (act === 'click') await page.mouse.click(...place);
  else await page.mouse.move(...place);
}

async function choose(page, name) {
  await page.locator('details[open] .views label', { hasText: new RegExp(`^${name}$`) }).first().click();
}

test('the first counterexample is open, at the sample in question', () => withPage(async (page) => {
  assert.equal(await titleOf(page), 'Pixel (3, 4) at (3.5, 4.5)');
  const facts = await factsOf(page);
  assert.equal(facts.exact, '97/70');
  assert.equal(facts['exact, nearest double'], '1.3857142857142857');
  // 97/70 is 5812297 1/7 units of 2^-22, and what was drawn 5812302.
  assert.match(facts.drawn, /^1\.3857155 0x1\.62be\w*p\+0 = 0x3fb15f/);
  assert.match(facts['error, scale ULP'], /^\+5\.\d+ in float32 spacings/);
  assert.match(facts['error, local ULP'], /^\+10\.\d+ in/);
  assert.match(facts['κ'], /^1 /);
  assert.match(facts['κ_D'], /^\[2\.5, 2\.75\]/);
  assert.equal(facts['distance to the boundary'], '0.707107 pixels');
  assert.match(facts['D = Σ e'], /^1(\.0+)? 1\/w$/);
}));

test('pointing at a pixel tells of it, and pinning stays there', () => withPage(async (page) => {
  await frameOf(page).scrollIntoViewIfNeeded();
  await pointAt(page, 2, 5);
  assert.match(await titleOf(page), /^Pixel \(2, 5\)/);
  assert.match(await page.locator('.panel .outcome').first().textContent(),
    /^missing: must be drawn/);
  await pointAt(page, 5, 4, 'click');
  assert.match(await titleOf(page), /^Pixel \(5, 4\).*pinned/);
  await pointAt(page, 2, 2);
  assert.match(await titleOf(page), /^Pixel \(5, 4\)/);
  await pointAt(page, 5, 4, 'click');
  await pointAt(page, 2, 2);
  assert.match(await titleOf(page), /^Pixel \(2, 2\)/);
}));

test('keys move, pin and let go, and stay within the part', () => withPage(async (page) => {
  await frameOf(page).focus();
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp']) await page.keyboard.press(key);
  assert.match(await titleOf(page), /^Pixel \(5, 3\).*pinned/);
  await page.keyboard.press('Enter');
  assert.doesNotMatch(await titleOf(page), /pinned/);
  await page.keyboard.press('Enter');
  assert.match(await titleOf(page), /pinned/);
  await page.keyboard.press('Escape');
  assert.doesNotMatch(await titleOf(page), /pinned/);
  for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowDown');
  assert.match(await titleOf(page), /^Pixel \(5, 7\)/);
  await page.keyboard.press('ArrowLeft');
  assert.match(await titleOf(page), /^Pixel \(4, 7\)/);
  assert.match(await page.locator('.spoken').first().textContent(),
    /^Pixel 4, 7: not drawn, as it must not be/);
}));

test('touch picks a pixel', () => withPage(async (page) => {
  await frameOf(page).scrollIntoViewIfNeeded();
  const plot = await page.locator('.picture rect.plot').first().boundingBox();
  await page.touchscreen.tap(plot.x + 2.5 * (plot.width / 8), plot.y + 2.5 * (plot.height / 8));
  assert.match(await titleOf(page), /^Pixel \(2, 2\).*pinned/);
}, { width: 390, options: { hasTouch: true, isMobile: true } }));

test('each view has its picture and its legend', () => withPage(async (page) => {
  const legend = () => page.locator('.legend').first().textContent();
  const cells = () => page.locator('details[open] .picture .in-cell').count();
  await choose(page, 'Coverage');
  assert.match(await legend(), /missing: must be drawn, and is not.*extra.*may be drawn or not/);
  assert.equal(await cells(), 0);
  // 3, 5, 4, 2 and 1 samples of the rows are inside; one of them is missing, one more is extra.
  for (const view of ['Expected', 'Drawn', 'Difference', 'ULP']) {
    await choose(page, view);
    assert.equal(await cells(), 15, view);
    assert.equal(await page.locator('.picture .g-missing').count(), view === 'Expected' ? 0 : 1);
  }
  assert.match(await legend(), /scale ULP.*≤ ½.*> 64.*above.*below.*NaN or ∞/);
}));

test('errors have a colour and a sign by their size', () => withPage(async (page) => {
  await choose(page, 'ULP');
  const cells = await page.locator('.picture').first().evaluate((picture) =>
    [...picture.querySelectorAll('.in-cell')].map((text) =>
      [text.textContent, getComputedStyle(text.previousSibling).fill]));
  const fillOf = (text) => cells.find(([content]) => content === text)?.[1];
  assert.equal(fillOf('5.03'), 'rgb(213, 94, 0)'); // ≤ 64
  assert.equal(fillOf('−1.94'), 'rgb(230, 159, 0)'); // ≤ 4
  assert.equal(fillOf('∞'), 'rgb(204, 121, 167)');
  await choose(page, 'Difference');
  assert.ok(await page.locator('.picture .in-cell').first().isVisible());
}));

test('small cells have signs where numbers have no room', () => withPage(async (page) => {
  const section = page.locator('[data-inspection="1"]');
  assert.ok((await section.locator('.in-cell').allTextContents()).includes('0.53'));
  await section.locator('.frame').evaluate((frame) => {
    frame.style.width = '240px';
  });
  await until(page, () =>
    document.querySelector('[data-inspection="1"] svg.picture').viewBox.baseVal.width < 250);
  // The one value that is off by more than half a unit.
  assert.deepEqual(await section.locator('.in-cell').allTextContents(), ['▲']);
}, { hash: '#inspection=1' }));

test('of a comparison the right side is what was drawn', () => withPage(async (page) => {
  await choose(page, 'Compare');
  // What is missing was not expected to be; it is on the side that the slider covers.
  const isClipped = await page.locator('.picture .g-missing').first().evaluate((sign) =>
    sign.closest('g[clip-path^="url(#swipe"]') !== null);
  assert.equal(isClipped, true);
  const uncovered = () => page.locator('.picture').first().evaluate((picture) => {
    const rect = picture.querySelector('clipPath[id^="swipe"] rect');
    const plot = picture.querySelector('rect.plot');
    const [x, width, left, all] = [rect, plot].flatMap((node) =>
      [Number(node.getAttribute('x')), Number(node.getAttribute('width'))]);
    return Math.abs(x + width - left - all) < 1e-9 ? width : NaN; // up to the right border
  });
  const slider = page.locator('.swipe input').first();
  await slider.focus();
  await page.keyboard.press('End');
  assert.equal(await uncovered(), 0);
  await page.keyboard.press('Home');
  const plot = Number(await page.locator('.picture rect.plot').first().getAttribute('width'));
  assert.ok(Math.abs((await uncovered()) - plot) < 1e-9);
}));

test('the slider moves from expected to drawn', () => withPage(async (page) => {
  const slider = page.locator('.swipe input').first();
  assert.equal(await slider.isVisible(), false);
  await choose(page, 'Compare');
  assert.equal(await slider.isVisible(), true);
  const divider = async () => Number(await page.locator('.picture .divider').first().getAttribute('x1'));
  const middle = await divider();
  await slider.focus();
  for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowRight');
  const step = (await divider()) - middle;
  assert.ok(step > 0);
  await page.keyboard.press('Home');
  assert.ok(Math.abs((await divider()) - (middle - 5 * step)) < 0.01);
  await page.keyboard.press('End');
  assert.ok(Math.abs((await divider()) - (middle + 5 * step)) < 0.01);
}));

test('depth and attributes are chosen by name', () => withPage(async (page) => {
  const select = page.locator('.controls select').first();
  assert.deepEqual(await select.locator('option').allTextContents(), ['depth', 'u & v (smooth)']);
  await select.selectOption('depth');
  // Depth at (3, 4) is (10 + 2·23 + 3·37)/280, of n_i / 70.
  assert.equal((await factsOf(page)).exact, '167/280');
  await page.getByRole('button', { name: 'Largest error' }).first().click();
  assert.match(await titleOf(page), /^Pixel \(3, 3\)/);
}));

test('samples of a pixel are chosen one by one', () => withPage(async (page) => {
  const section = page.locator('[data-inspection="1"]');
  assert.equal(await titleOf(page, 1), 'Pixel (4, 3), sample 1 at (4.25, 3.25)');
  await section.locator('.frame').focus();
  await page.keyboard.press('s');
  assert.match(await titleOf(page, 1), /^Pixel \(4, 3\), sample 0 at \(4.75, 3.75\)/);
  await section.locator('.jumps select').selectOption('1');
  assert.match(await titleOf(page, 1), /sample 1/);
  assert.match(await section.locator('.viewer').textContent(), /No q-matrix/);
}, { hash: '#inspection=1' }));

test('a link opens a sample and a view, and follows', () => withPage(async (page) => {
  assert.match(await titleOf(page), /^Pixel \(5, 4\).*pinned/);
  assert.equal(await page.locator('.views input[value="compare"]').first().isChecked(), true);
  assert.equal(await page.locator('.swipe input').first().inputValue(), '30');
  await frameOf(page).focus();
  await page.keyboard.press('ArrowLeft');
  await until(page, () => location.hash.includes('x=4&y=4&sample=0&view=compare&value=0&swipe=30'));
  await page.evaluate(() => {
    location.hash = '#inspection=1&x=4&y=3&sample=0&view=difference';
  });
  await until(page, () => document.getElementById('inspection=1').open);
  assert.match(await titleOf(page, 1), /^Pixel \(4, 3\), sample 0/);
}, { hash: '#inspection=0&x=5&y=4&sample=0&view=compare&swipe=30' }));

test('a link that means nothing changes nothing', () => withPage(async (page) => {
  assert.match(await titleOf(page), /^Pixel \(3, 4\)/);
  assert.equal(await page.locator('.views input[value="ulp"]').first().isChecked(), true);
}, { hash: '#inspection=0&x=99&y=-4&sample=7&view=sideways&value=12&swipe=no' }));
