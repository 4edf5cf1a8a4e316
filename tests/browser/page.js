// A browser and pages in it, which have to be silent and to ask for nothing.

import assert from 'node:assert/strict';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const kChromium = process.env.RASTERCHECK_CHROMIUM ?? '/usr/bin/chromium';

/** The report that the tests are of: a run with two inspections (tests/reports/sample_run.h). */
export const kReport = pathToFileURL(process.env.RASTERCHECK_REPORT).href;

let browser;

/** For before() and after() of a file of tests. */
export async function startBrowser() {
  // The sandbox cannot be had as root, and pages are our own.
  browser = await chromium.launch({ executablePath: kChromium, args: ['--no-sandbox'] });
}
export async function stopBrowser() {
  await browser?.close();
}

/**
 * Opens a page, gives it to `use`, and sees that it neither complained nor asked for anything.
 * @param {(page: import('playwright-core').Page) => Promise<void>} use
 * @param {{hash?: string, report?: string, width?: number, height?: number,
 *          options?: import('playwright-core').BrowserContextOptions}} [how]
 */
export async function withPage(use, { hash = '', report = kReport, width = 1280, height = 900,
  options = {} } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`error: ${error.message}`));
  await page.route(/.*/, (route) => {
    const url = route.request().url();
    if (url.startsWith(report) || url.startsWith('data:')) return route.continue();
    complaints.push(`request: ${url}`);
    return route.abort();
  });
  try {
    await page.goto(report + hash);
    await use(page);
  } finally {
    await context.close();
  }
  assert.deepEqual(complaints, []);
}

/** Waits until a function of the page is true. */
export async function until(page, condition, argument) {
  await page.waitForFunction(condition, argument, { timeout: 10_000 });
}

/** What the panel of the first open viewer says, by term. */
export async function factsOf(page) {
  return page.locator('details[open] .panel').first().evaluate((panel) =>
    Object.fromEntries([...panel.querySelectorAll('dl > div')].map((fact) =>
      [fact.querySelector('dt').textContent, fact.querySelector('dd').textContent])));
}

/** The title of an inspection's panel: "Pixel (3, 4) at (3.5, 4.5)". */
export async function titleOf(page, inspection = 0) {
  return page.locator(`[data-inspection="${inspection}"] .panel h4`).textContent();
}
