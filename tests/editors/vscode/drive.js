// Works in VS Code's window as a user does, in a browser: opens files, presses keys, reads.
// In: node drive.js URL CHROMIUM RESULT. Out: the file RESULT, one JSON object of what was seen.

const fs = require("fs");
const { chromium } = require("playwright-core");

const WAIT_MS = 60000;
const [url, executablePath, result] = process.argv.slice(2);
const seen = {};

async function open(page, name) {
  await page.getByRole("treeitem", { name }).first().dblclick();
  await page.getByRole("tab", { name, selected: true }).waitFor();
  await page.locator(".editor-group-container.active .view-lines").click();
}

// Chosen by a click: Enter takes the row that has the focus, which may be one of the list before the last letter.
async function command(page, title) {
  await page.keyboard.press("F1");
  const box = page.locator(".quick-input-box input.input");
  await box.fill(`>${title}`);
  const rows = page.locator(".quick-input-list .monaco-list-row");
  await rows.filter({ has: page.getByText(title, { exact: true }) }).first().click();
  await page.locator(".quick-input-widget").waitFor({ state: "hidden" });
}

async function go(page, line, column) {
  await page.keyboard.press("Control+G");
  const box = page.locator(".quick-input-box input.input");
  await box.fill(`:${line}:${column}`);
  await page.keyboard.press("Enter");
  await page.locator(".quick-input-widget").waitFor({ state: "hidden" });
  await status(page, `Ln ${line}, Col ${column}`);
}

async function status(page, text) {
  await page.locator(".statusbar-item").filter({ hasText: text }).first().waitFor();
}

// The rows of the Problems panel, once there are some about the file.
async function problems(page, name) {
  await open(page, name);
  await page.locator(".squiggly-error").first().waitFor();
  const rows = page.locator(".markers-panel .monaco-list-row");
  await rows.filter({ hasText: name }).first().waitFor();
  return (await rows.allInnerTexts()).map((text) => text.replace(/\s+/g, " "));
}

async function findings(page) {
  await command(page, "View: Toggle Problems");
  await page.locator(".markers-panel").waitFor();
  seen.problems = {};
  for (const name of ["wrong.cdsl", "wrong.idsl", "wrong.pdsl", "wrong.ddsl", "wrong.scxml", "wrong.xml"]) {
    seen.problems[name] = await problems(page, name);
  }
  await status(page, "RoboComp body");
  await command(page, "View: Toggle Problems");
}

async function reading(page) {
  await open(page, "reader.cdsl");
  await status(page, "RoboComp component");
  await go(page, 5, 31);
  await command(page, "Show or Focus Hover");
  const hover = page.locator(".monaco-hover:visible").filter({ hasText: "interface" }).first();
  await hover.waitFor();
  seen.hover = await hover.innerText();
  await page.keyboard.press("Escape");
  await command(page, "Go to Definition");
  await page.getByRole("tab", { name: "Laser.idsl", selected: true }).waitFor();
  await status(page, "Ln 7, Col 15");
  seen.definition = true;
}

// The lens above the interface leads to VS Code's own list of places.
async function lenses(page) {
  const lens = page.locator(".codelens-decoration a").filter({ hasText: /components? requires? this/ }).first();
  await lens.waitFor();
  seen.lens = await lens.innerText();
  await lens.click();
  const peek = page.locator(".peekview-widget");
  await peek.waitFor();
  seen.peek = await peek.innerText();
  await page.keyboard.press("Escape");
  await peek.waitFor({ state: "hidden" });
}

async function changing(page) {
  await open(page, "ugly.cdsl");
  await command(page, "Format Document");
  await page.locator(".view-line").filter({ hasText: /^\s{4}Communications/ }).first().waitFor();
  await command(page, "File: Save");
  await page.locator(".tab.active.dirty").waitFor({ state: "detached" });
  await open(page, "reader.cdsl");
  await command(page, "RoboComp: Generate component");
  await page.getByRole("treeitem", { name: "specificworker.py" }).first().waitFor();
}

async function everything(page) {
  page.setDefaultTimeout(WAIT_MS);
  await page.goto(url);
  await page.getByRole("button", { name: "Yes, I trust the authors" }).click();
  await findings(page);
  await reading(page);
  await lenses(page);
  await changing(page);
}

async function main() {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 1600, height: 2400 } });
  try {
    await everything(page);
  } catch (error) {
    seen.failure = String(error.stack);
    await page.screenshot({ path: `${result}.png` });
  }
  await browser.close();
  fs.writeFileSync(result, JSON.stringify(seen));
}

void main();
