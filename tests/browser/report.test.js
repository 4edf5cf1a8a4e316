// The page around the viewer: what is there without scripts, on a phone, in the dark, for the keyboard.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { startBrowser, stopBrowser, until, withPage } from './page.js';

before(startBrowser);
after(stopBrowser);

const column = (table, index) =>
  table.locator(`:scope > tbody > tr:first-child > td:nth-child(${index})`).allTextContents();

test('headers sort their table, by mouse and by keys', () => withPage(async (page) => {
  const table = page.locator('table.verdicts');
  const header = table.locator(':scope > thead th', { hasText: 'worst' });
  assert.equal(await header.getAttribute('aria-sort'), 'none');
  await header.getByRole('button').click();
  assert.equal(await header.getAttribute('aria-sort'), 'descending');
  assert.deepEqual(await column(table, 4), ['0.7', '0.5', '0.5', '0.5']);
  await header.getByRole('button').focus();
  await page.keyboard.press('Enter');
  assert.equal(await header.getAttribute('aria-sort'), 'ascending');
  assert.deepEqual(await column(table, 4), ['0.5', '0.5', '0.5', '0.7']);
  await table.locator(':scope > thead th', { hasText: 'backend' }).getByRole('button').click();
  assert.equal(await header.getAttribute('aria-sort'), 'none');
  assert.deepEqual((await column(table, 2)).slice(0, 2), ['cpu', 'cpu']);
  // The row with the sentence stays with its figures.
  assert.deepEqual(await table.locator(':scope > tbody').evaluateAll((all) =>
    all.map((body) => body.rows[0].cells[0].textContent === body.querySelector('details').dataset.property)),
  [true, true, true, true]);
}));

test('what is wrong comes first, and the first counterexample is open', () => withPage(async (page) => {
  assert.equal(await page.locator('h1').textContent(), '1 of 3 properties violated, 1 cause');
  assert.match(await page.title(), /^cpu, method:float32: 1 of 3 properties violated, 1 cause – /);
  assert.match(await page.locator('table.verdicts > tbody').first().textContent(),
    /values are within bounds.*violated in 2 cases/);
  const open = page.locator('details.finding[open]');
  assert.equal(await open.count(), 1);
  assert.match(await open.locator('summary').first().textContent(), /was drawn as 16.800001 and must be 16.8/);
}));

test('a link opens a property', () => withPage(async (page) => {
  await until(page, () => document.getElementById('property=coverage+is+exact').open);
}, { hash: '#property=coverage+is+exact' }));

test('a link opens a counterexample among the others of its cause', () => withPage(async (page) => {
  await page.evaluate(() => {
    const other = document.querySelector('details.others details.finding');
    other.dataset.inspection = '77';
    location.hash = '#inspection=77';
  });
  await until(page, () => document.querySelector('details.others').open);
  assert.equal(await page.locator('details.others details.finding').first().isVisible(), true);
}));

test('histograms tell the share of errors up to a bar', () => withPage(async (page) => {
  const law = page.locator('details.property').last();
  await law.locator('summary').first().click();
  const figure = law.locator('figure[data-histogram]').first();
  await figure.scrollIntoViewIfNeeded();
  await figure.locator('.bars rect').last().hover();
  assert.match(await figure.locator('.said').textContent(), /error ≤ 0.5 scale ULP: 100% of all/);
  assert.match(await figure.locator('text.limit').textContent(), /correct rounding 0.5/);
}));

test('all of it is there without scripts', () => withPage(async (page) => {
  assert.equal(await page.locator('table.verdicts > tbody').count(), 4);
  const finding = await page.locator('details.finding').first().textContent();
  assert.match(finding, /u & v is exactly 97\/70.*most of this error is from set-up/);
  assert.match(finding, /set-up\+6\.5.*total\+5\.25/s);
  assert.equal(await page.locator('details.finding pre').first().isVisible(), true);
  await page.locator('details.property summary').first().click();
  assert.ok(await page.locator('details[open] figure svg rect').count() > 3);
  assert.equal(await page.locator('.viewer').count(), 0);
  await page.locator('#worst summary').first().click();
  assert.match(await page.locator('#worst details').first().innerText(), /left open\s*-0\.25/);
}, { options: { javaScriptEnabled: false } }));

test('it is dark where the reader wants that', async () => {
  const brightness = (page) => page.evaluate(() => {
    const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
    return (r + g + b) / 3;
  });
  await withPage(async (page) => assert.ok(await brightness(page) > 200));
  await withPage(async (page) => assert.ok(await brightness(page) < 60),
    { options: { colorScheme: 'dark' } });
});

for (const width of [360, 390, 768, 1280]) {
  test(`nothing is wider than a screen of ${width} pixels`, () => withPage(async (page) => {
    await page.locator('details').evaluateAll((all) => all.forEach((details) => {
      details.open = true;
    }));
    await until(page, () => document.querySelectorAll('.viewer').length === 2);
    for (const view of ['coverage', 'compare', 'ulp']) {
      await page.locator(`.views input[value="${view}"]`).evaluateAll((all) =>
        all.forEach((input) => input.click()));
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    }
  }, { width }));
}

test('whatever can be used has a name, and ids are of one element', () => withPage(async (page) => {
  await page.locator('details').evaluateAll((all) => all.forEach((details) => {
    details.open = true;
  }));
  await until(page, () => document.querySelectorAll('.viewer').length === 2);
  const faults = await page.evaluate(() => {
    const found = [];
    const name = (node) => node.getAttribute('aria-label') || node.labels?.[0]?.textContent ||
      node.textContent.trim();
    for (const node of document.querySelectorAll('input, select, button, a, [tabindex], summary')) {
      if (!name(node)) found.push(`no name: ${node.outerHTML.slice(0, 80)}`);
    }
    for (const node of document.querySelectorAll('img:not([alt]), svg:not([aria-hidden]):not([aria-label])')) {
      found.push(`no text: ${node.outerHTML.slice(0, 80)}`);
    }
    const ids = [...document.querySelectorAll('[id]')].map((node) => node.id);
    if (new Set(ids).size !== ids.length) found.push('an id twice');
    for (const node of document.querySelectorAll('[aria-describedby]')) {
      if (!document.getElementById(node.getAttribute('aria-describedby'))) found.push('no description');
    }
    return found;
  });
  assert.deepEqual(faults, []);
}));

test('keys alone reach everything of a viewer', () => withPage(async (page) => {
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => {
      const node = document.activeElement;
      return node.classList.contains('frame') ? 'frame' : node.localName + (node.type ? `:${node.type}` : '');
    }));
  }
  for (const kind of ['button:button', 'summary', 'frame', 'input:radio', 'select:select-one']) {
    assert.ok(reached.has(kind), kind);
  }
}));

// How long it takes is told, and not judged.
test('a report of a real run opens', { skip: !process.env.RASTERCHECK_RUN_REPORT }, async (t) => {
  const report = pathToFileURL(process.env.RASTERCHECK_RUN_REPORT).href;
  await withPage(async (page) => {
    const loaded = await page.evaluate(() => performance.getEntriesByType('navigation')[0].loadEventEnd);
    t.diagnostic(`loaded in ${Math.round(loaded)} ms`);
    assert.ok(await page.locator('table.verdicts > tbody').count() > 10);
    assert.ok(await page.evaluate(() => document.documentElement.scrollHeight) < 6000);
    const sections = page.locator('details[data-inspection]');
    await sections.evaluateAll((all) => all.forEach((details) => {
      details.open = true;
    }));
    const count = await sections.count();
    t.diagnostic(`${count} inspections`);
    await until(page, (all) => document.querySelectorAll('.viewer').length === all, count);
    await page.locator('details').evaluateAll((all) => all.forEach((details) => {
      details.open = true;
    }));
    for (const width of [360, 768, 1280]) {
      await page.setViewportSize({ width, height: 900 });
      // Places in a picture are those that it is drawn with.
      await until(page, () => [...document.querySelectorAll('svg.picture')].every((picture) =>
        Math.abs(picture.getBoundingClientRect().width - picture.viewBox.baseVal.width) < 0.01));
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    }
  }, { report });
});
