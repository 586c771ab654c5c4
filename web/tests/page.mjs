// Tries the page in Debian's Chromium: node page.mjs FOLDER, where pictures and measured times go. The exit status is 1
// where something does not hold.
import assert from "node:assert/strict";
import {createHash} from "node:crypto";
import {mkdirSync, readFileSync, readdirSync, statSync, writeFileSync} from "node:fs";
import {fileURLToPath} from "node:url";
import {gzipSync} from "node:zlib";
import {chromium} from "playwright-core";
import {mesh} from "../../build/browser/package/dist/lamina.js";
import {serve} from "../serve.mjs";

const root = fileURLToPath(new URL("../..", import.meta.url)),
  folder = process.argv[2] ?? `${root}out/web/mesher`;
mkdirSync(folder, {recursive: true});
const measured = {};

// --- What has to be loaded

const site = `${root}build/browser/site`;
const compressed = (folder, without = "") =>
  readdirSync(folder)
    .filter((name) => name !== without && statSync(`${folder}/${name}`).isFile())
    .reduce((sum, name) => sum + gzipSync(readFileSync(`${folder}/${name}`), {level: 9}).length, 0);
measured.compressedBytes = {
  oneThread: compressed(site),
  threads: compressed(site, "lamina.wasm") + compressed(`${site}/threads`),
};
for (const bytes of Object.values(measured.compressedBytes)) assert(bytes <= 2e6, `the page has ${bytes} bytes`);

// --- The page

const {address, close} = await serve(site);
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const context = await browser.newContext({
  viewport: {width: 1440, height: 900},
  acceptDownloads: true,
  reducedMotion: "reduce",
});
const page = await context.newPage();
const problems = [];
// SwiftShader, which draws here without a graphics card, says where it waits for itself.
page.on("console", (message) => {
  if (["error", "warning"].includes(message.type()) && !message.text().includes("GL Driver Message"))
    problems.push(message.text());
});
page.on("pageerror", (error) => problems.push(String(error)));
page.on("request", (request) => {
  if (!request.url().startsWith(address) && !/^(data|blob):/.test(request.url()))
    problems.push(`foreign request: ${request.url()}`);
});

const headline = () => page.textContent("#headline");
/** Calls change() and waits for the mesh, or the error, that follows. */
async function after(change, state = "done") {
  await page.evaluate(() => {
    document.body.dataset.state = "waiting";
  });
  await change();
  await page.waitForFunction((wanted) => document.body.dataset.state === wanted, state, {timeout: 120_000});
}
const setOption = (key, text) =>
  after(async () => {
    const field = page.locator(`#main-options [data-key=${key}] .text`);
    await field.fill(text);
    await field.dispatchEvent("change");
  });
const picture = (name) => page.screenshot({path: `${folder}/${name}.png`});
const canvasShot = async () =>
  createHash("sha256")
    .update(await page.locator(".stage").screenshot())
    .digest("hex");
const settle = () => page.waitForTimeout(1000);

try {
  await page.goto(address);
  await page.waitForFunction(() => document.body.dataset.state === "done", null, {timeout: 60_000});
  await settle();
  assert.match(await headline(), /cells in/);
  measured.threads = Number(await page.evaluate(() => document.body.dataset.threads));
  assert.equal(measured.threads, await page.evaluate(() => Math.min(navigator.hardwareConcurrency, 16)));
  await picture("page");

  // The first mesh includes what compiling costs; the second is what a person feels.
  const times = [];
  for (let i = 0; i < 5; ++i) {
    await after(() => page.evaluate(() => document.querySelector("#naca").dispatchEvent(new Event("change"))));
    times.push(Number(/in ([\d.]+) s/.exec(await headline())[1]));
  }
  measured.naca0012Seconds = Math.min(...times);
  assert(measured.naca0012Seconds <= 0.3, `NACA 0012 takes ${measured.naca0012Seconds} s`);

  // Every place and every colour changes the picture.
  const shots = new Set([await canvasShot()]);
  const buttons = await page.locator("#places button").allTextContents();
  for (const expected of ["far field", "bodies", "nose", "tail", "first cells"])
    assert(buttons.includes(expected), expected);
  for (const name of buttons) {
    await page.click(`#places button:text-is("${name}")`);
    await settle();
    shots.add(await canvasShot());
    await picture(`place-${name.replaceAll(" ", "-")}`);
  }
  assert(shots.size >= buttons.length, "places look the same");
  await page.click('#places button:text-is("nose")');
  await settle();
  for (const name of ["none", "minAngle", "layer", "size", "piece"]) {
    await page.selectOption("#color", name);
    await settle();
    const shot = await canvasShot();
    assert(!shots.has(shot), `colour ${name} shows nothing`);
    shots.add(shot);
    await picture(`color-${name}`);
  }

  // A cell tells its numbers.
  const box = await page.locator("#view").boundingBox();
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
  assert.match(await page.textContent("#picked"), /cell \d+/);

  // At the tail, at a first height of 1e-7 chords, a view that moves by 40 pixels moves the picture by 40 pixels.
  // Single precision would misplace points by as many.
  await setOption("first_height", "1e-7");
  await page.selectOption("#color", "none");
  const shift = 40,
    half = 5e-7;
  const rowAt = (x) =>
    page.evaluate(
      ([at, size]) => {
        lamina.picture.show([at - size, -size, at + size, size], false);
        return Array.from(lamina.picture.pixelRow(0.3));
      },
      [x, half],
    );
  const row = await rowAt(1);
  await picture("tail-1e-7");
  const {scale} = await page.evaluate(() => lamina.picture.state());
  measured.pixelsPerChord = scale;
  assert(scale > 1e8, `the view shows ${scale} pixels for each chord`);
  const moved = await rowAt(1 + shift / scale);
  let compared = 0,
    moveless = 0,
    wrong = 0;
  for (let x = shift; 4 * x < row.length; ++x)
    for (let k = 0; k < 3; ++k, ++compared) {
      if (Math.abs(row[4 * x + k] - moved[4 * (x - shift) + k]) > 16) ++wrong;
      if (Math.abs(row[4 * x + k] - moved[4 * x + k]) > 16) ++moveless;
    }
  measured.jitter = {compared, wrong, wrongWithoutShift: moveless};
  assert(moveless > 0, "the row shows nothing");
  assert(wrong <= 0.002 * compared, `${wrong} of ${compared} values did not move along`);
  await page.click('#places button:text-is("first cells")');
  await settle();
  await picture("first-cells");

  // Wrong options and wrong inputs are told, and the page goes on.
  await setOption("first_height", "");
  await after(async () => {
    const field = page.locator("#main-options [data-key=growth] .text");
    await field.fill("0.5");
    await field.dispatchEvent("change");
  }, "failed");
  assert.match(await page.textContent("#error"), /growth/);
  assert((await page.locator("#main-options [data-key=growth].wrong").count()) === 1);
  await picture("wrong-option");
  await setOption("growth", "");
  await after(
    () =>
      page
        .locator("#naca")
        .fill("12x")
        .then(() => page.locator("#naca").dispatchEvent("change")),
    "failed",
  );
  await picture("wrong-input");
  await after(() =>
    page
      .locator("#naca")
      .fill("2412")
      .then(() => page.locator("#naca").dispatchEvent("change")),
  );

  // Files: three elements, with a Reynolds number; what is downloaded is what the package writes.
  const names = ["slat", "main", "flap"].map((part) => `${root}examples/geometry/crmhl2d_${part}.dat`);
  await after(() => page.setInputFiles("#files", names));
  await setOption("reynolds", "5e6");
  for (const expected of ["nose 3", "tail 3", "slot 2", "first cells 3"])
    assert.equal(await page.locator(`#places button:text-is("${expected}")`).count(), 1, expected);
  await page.waitForTimeout(2000);
  await picture("three-elements");
  const download = async (label) => {
    const [given] = await Promise.all([
      page.waitForEvent("download"),
      page.click(`#downloads button:text-is("${label}")`),
    ]);
    return {name: given.suggestedFilename(), bytes: readFileSync(await given.path())};
  };
  const files = names.map((path) => ({name: path.replace(/.*\//, ""), text: readFileSync(path)}));
  const same = await mesh(files, {reynolds: 5e6});
  for (const [label, name] of [
    ["SU2", "mesh.su2"],
    ["Gmsh MSH", "mesh.msh"],
    ["VTU", "mesh.vtu"],
  ]) {
    const file = await download(label);
    assert.equal(file.name, name);
    assert(file.bytes.equals(same.write(name)[0].bytes), `${name} differs`);
  }
  const zipped = await download("OpenFOAM");
  assert.equal(zipped.name, "polyMesh.zip");
  assert.equal(zipped.bytes.readUInt32LE(0), 0x04034b50);

  // The address holds the case, files included: another page makes the same mesh of it.
  const cells = async (of) => /([\d,]+) cells/.exec(await of.textContent("#headline"))[1];
  const kept = (pattern) => page.waitForFunction((wanted) => new RegExp(wanted).test(location.hash), pattern.source);
  await kept(/^#file=crmhl2d_slat\.dat:[\w-]+&file=.*&reynolds=5e6$/);
  measured.linkCharacters = page.url().length;
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.click("#copy");
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), page.url());
  const linked = await context.newPage();
  await linked.goto(page.url());
  await linked.waitForFunction(() => document.body.dataset.state === "done", null, {timeout: 60_000});
  assert.equal(await cells(linked), await cells(page));
  assert.equal(await linked.textContent("#command"), await page.textContent("#command"));
  // A link that is damaged, or from another version, says so.
  for (const [hash, pattern] of [
    ["#file=x.dat:AAAA", /damaged/],
    ["#file", /damaged/],
    ["#groth=1.3", /groth/],
  ]) {
    await linked.evaluate((text) => {
      document.body.dataset.state = "waiting";
      location.hash = text;
    }, hash);
    await linked.waitForFunction(() => document.body.dataset.state === "failed");
    assert.match(await linked.textContent("#error"), pattern);
  }
  await linked.close();
  // A link that is typed over the address of an open page.
  await after(() => page.evaluate(() => void (location.hash = "#naca=0018:blunt&alpha=3")));
  assert.equal(await page.inputValue("#naca"), "0018:blunt");
  assert.match(await page.textContent("#command"), /^lamina mesh naca:0018:blunt --alpha 3 /);
  // Undo goes back step by step, and reset is a step, too.
  await setOption("alpha", "4");
  await kept(/^#naca=0018:blunt&alpha=4$/);
  await after(() => page.click("#reset"));
  await kept(/^$/);
  assert.equal(await page.inputValue("#naca"), "0012");
  for (const hash of [
    /^#naca=0018:blunt&alpha=4$/,
    /^#naca=0018:blunt&alpha=3$/,
    /^#file=crmhl2d_slat.*&reynolds=5e6$/,
  ]) {
    await after(() => page.keyboard.press("Control+z"));
    await kept(hash);
  }
  assert.equal(await page.locator("#list li").count(), 3);
  await after(() => page.click("#list button"));
  assert.equal(await page.locator("#list li").count(), 2);
  // Each example makes a mesh. Curved cells are written as such, or refused.
  const examples = (await page.locator("#examples option").allTextContents()).slice(1);
  assert(examples.length >= 5);
  measured.examples = {};
  for (const label of examples) {
    await after(() => page.selectOption("#examples", label));
    measured.examples[label] = await headline();
  }
  assert.match(await page.textContent("#facts"), /cells of order 3/);
  assert((await download("Gmsh MSH")).bytes.length > 0);
  await after(() => page.click('#downloads button:text-is("SU2")'), "failed");
  assert.match(await page.textContent("#error"), /curved/);
  await picture("curved");
  // Pressures beside the mesh: none without a Reynolds number, a curve for each element, cp* where flow is that fast. The
  // chart and the mesh show the same point.
  const curves = page.locator("#pressures path.curve"),
    told = () => page.textContent("#pressures p");
  await after(() => page.selectOption("#examples", "NACA 0012, inviscid"));
  assert.equal(await curves.count(), 0);
  assert.match(await told(), /Reynolds/);
  await after(() => page.selectOption("#examples", "CRM-HL with slat and flap"));
  assert.equal(await curves.count(), 3);
  assert.equal(new Set(await curves.evaluateAll((all) => all.map((one) => one.getAttribute("stroke")))).size, 3);
  await picture("pressures-three-elements");
  await after(() => page.selectOption("#examples", "RAE 2822, transonic: finer at the shock"));
  assert.match(await told(), /^Euler equations at 2.31 degrees, Mach 0.729: lift coefficient 0\.[78]/);
  assert.equal(await page.locator("#pressures .critical").count(), 1);
  const chartBox = await page.locator("#pressures svg").boundingBox(),
    unhovered = await canvasShot();
  await page.mouse.move(chartBox.x + 0.4 * chartBox.width, chartBox.y + 0.12 * chartBox.height);
  assert.match(await told(), /^airfoil at \(0\.\d+, 0\.\d+\): cp -1\.\d+$/);
  assert(await page.locator("#pressures .dot-of-curve").isVisible());
  await settle();
  assert.notEqual(await canvasShot(), unhovered, "the mesh does not show the point");
  await picture("pressures");
  await page.mouse.move(chartBox.x, chartBox.y - 80);
  assert.match(await told(), /^Euler/);
  // At the nose of the section the pointer is near to the wall, too.
  const nose = await page.evaluate(() => {
    lamina.picture.show([-0.1, -0.1, 0.1, 0.1], false);
    return lamina.picture.state();
  });
  const stage = await page.locator("#view").boundingBox();
  await page.mouse.move(
    stage.x + 0.5 * nose.width + nose.scale * (0 - nose.x),
    stage.y + 0.5 * nose.height - nose.scale * (0 - nose.y),
  );
  assert.match(await told(), /^airfoil at \(/);
  // Help at each field.
  const fields = page.locator("#form .option"),
    help = page.locator("#main-options [data-key=reynolds]");
  assert.equal(await page.locator("#form .option > .help").count(), await fields.count());
  assert(!(await help.locator(".hint").isVisible()));
  await help.locator(".help").click();
  assert.match(await help.locator(".hint").textContent(), /Reynolds/);
  assert(await help.locator(".hint").isVisible());
  await picture("help");
  await help.locator(".help").click();
  await after(() => page.click("#reset"));

  // 50,000 triangles within a second; a million without running out of memory.
  await setOption("gradation", "0.06");
  const medium = await headline();
  measured.medium = medium;
  assert(Number(/([\d,]+) cells/.exec(medium)[1].replaceAll(",", "")) >= 50_000, medium);
  assert(Number(/in ([\d.]+) s/.exec(medium)[1]) < 1, medium);
  await setOption("gradation", "");
  await page.click("#more summary");
  await after(async () => {
    const field = page.locator("#all-options [data-key=refine] .text");
    await field.fill("box:-2,-2,3,2,0.0062");
    await field.dispatchEvent("change");
  });
  measured.large = await headline();
  assert(Number(/([\d,]+) cells/.exec(measured.large)[1].replaceAll(",", "")) >= 1_000_000, measured.large);
  await settle();
  await picture("million");
  measured.frameMilliseconds = (await page.evaluate(() => lamina.picture.state())).frameTime;

  for (const threads of [1, 2]) {
    await after(async () => {
      const field = page.locator("#all-options [data-key=threads] .text");
      await field.fill(String(threads));
      await field.dispatchEvent("change");
    });
    measured[`largeOn${threads}`] = await headline();
  }

  await page.emulateMedia({colorScheme: "dark"});
  await settle();
  await picture("dark");
  assert.deepEqual(problems, []);

  // Servers of static files need not isolate the page: it then makes do with one thread.
  const plain = await serve(site, 0, false),
    other = await browser.newPage();
  await other.goto(plain.address);
  await other.waitForFunction(() => document.body.dataset.state === "done", null, {timeout: 60_000});
  assert.equal(await other.evaluate(() => document.body.dataset.threads), "1");
  plain.close();
} catch (error) {
  await picture("failed");
  console.error(problems.join("\n"));
  throw error;
} finally {
  await browser.close();
  close();
  writeFileSync(`${folder}/measured.json`, `${JSON.stringify(measured, null, 2)}\n`);
  console.log(measured);
}
