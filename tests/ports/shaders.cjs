// SPDX-License-Identifier: Apache-2.0
// node shaders.cjs PORTS glsl|wgsl FOLDER: runs the shader port in Chromium (WebGL 2, or WebGPU by a software adapter) for the draws of
// tests/ports/vectors.c and compares hashes with PORTS/vectors.txt; then for draws in pairs of uses, pixels and frames, which are to
// be independent; then its example, which prints what all examples do. Exit code 77: Chromium, playwright-core or the interface is not
// there. FOLDER has playwright-core.
const fs = require("fs");
const [ports, language, modules] = process.argv.slice(2);
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [modules] })); } catch { playwright = null; }
const skip = why => { console.log("skipped: " + why); process.exit(77); };
if (!chromium || !playwright) skip((chromium ? "playwright-core" : "Chromium") + " is not installed (scripts/setup browser)");
const [source, keys] = ["sampler", "keys"].map(name => fs.readFileSync(`${ports}/${language}/koksma_${name}.${language}`, "utf8"));
const numbers = ["", "_four", "_single"].flatMap(name => fs.readFileSync(`${ports}/../include/koksma/keys_4d${name}.def`, "utf8")
  .replace(/\/\*[^]*?\*\//g, "").match(/\d+/g).map(Number)); // 128 x 104

// Domain and index of draw k: of the vectors; and of sample 3 of 4,096 pixels, each in one use, in another, in the next pixel and in the
// next frame.
const glsl = {
  hashesOf: `
    uvec2 seed = koksma_seed_of_frame(uvec2(0x89abcdefu ^ k >> 18, 0x01234567u), k >> 16 & 3u);
    uvec2 use = koksma_domain_of_use(koksma_domain_of_pixel(seed, k & 255u, k >> 8 & 255u), k % 5u);
    uvec2 domain = koksma_domain_of_sample(use, k % 3u);
    uint index = k * 2654435761u >> (k % 25u);`,
  dependentOf: `
    uint other = k >> 12 & 3u;
    uvec2 seed = koksma_seed_of_frame(uvec2(1u, 0u), other == 3u ? 1u : 0u);
    uvec2 pixel = koksma_domain_of_pixel(seed, (k & 63u) + (other == 2u ? 1u : 0u), k >> 6 & 63u);
    uvec2 domain = koksma_domain_of_use(pixel, other == 1u ? 1u : 0u);
    uint index = 3u;`,
};
const wgsl = {
  hashesOf: `
    let seed = koksma_seed_of_frame(vec2u(0x89abcdefu ^ (k >> 18u), 0x01234567u), (k >> 16u) & 3u);
    let used = koksma_domain_of_use(koksma_domain_of_pixel(seed, k & 255u, (k >> 8u) & 255u), k % 5u);
    let domain = koksma_domain_of_sample(used, k % 3u);
    let index = (k * 2654435761u) >> (k % 25u);`,
  dependentOf: `
    let other = (k >> 12u) & 3u;
    let seed = koksma_seed_of_frame(vec2u(1u, 0u), select(0u, 1u, other == 3u));
    let pixel = koksma_domain_of_pixel(seed, (k & 63u) + select(0u, 1u, other == 2u), (k >> 6u) & 63u);
    let domain = koksma_domain_of_use(pixel, select(0u, 1u, other == 1u));
    let index = 3u;`,
};

const fragment = draw => `#version 300 es
precision highp float;
precision highp int;
${source}${keys}
uniform highp usampler2D numbers;
uint koksma_key_at(uint i)
{
    return texelFetch(numbers, ivec2(i & 127u, i >> 7), 0).x;
}
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;
layout(location = 2) out uvec4 third;
layout(location = 3) out uvec4 fourth;
void main()
{
    uint k = uint(gl_FragCoord.y) * 1024u + uint(gl_FragCoord.x);${draw}
    first = uvec4(domain, koksma_pmj02(domain, index));
    second = koksma_sobol(domain, index);
    third = koksma_white(domain, index);
    uint spp = 1u + k % 130u;
    fourth = koksma_keys_4d(koksma_keys_of_4d(seed, k & 255u, k >> 8 & 255u, k % 5u, spp), index % spp);
}`;

const compute = draw => `${source}${keys}
@group(0) @binding(0) var<storage, read_write> words: array<vec4u>;
@group(0) @binding(1) var<uniform> first: vec4u;
@group(0) @binding(2) var<storage, read> numbers: array<u32>;
fn koksma_key_at(i: u32) -> u32 { return numbers[i]; }
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u)
{
    let k = first.x + id.x;${draw}
    words[4u * id.x] = vec4u(domain, koksma_pmj02(domain, index));
    words[4u * id.x + 1u] = koksma_sobol(domain, index);
    words[4u * id.x + 2u] = koksma_white(domain, index);
    let spp = 1u + k % 130u;
    words[4u * id.x + 3u] = koksma_keys_4d(koksma_keys_of_4d(seed, k & 255u, (k >> 8u) & 255u, k % 5u, spp), index % spp);
}`;

// In the page: what hashesOf or dependentOf makes of all draws by WebGL, or a reason why there are none.
function byWebGL(text, what, numbers) {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return { missing: "no WebGL 2" };
  const program = gl.createProgram();
  const vertex = "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }";
  for (const [kind, of] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, text]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, of);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return { wrong: gl.getShaderInfoLog(shader) };
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return { wrong: gl.getProgramInfoLog(program) };
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  const targets = [0, 1, 2, 3].map(k => gl.COLOR_ATTACHMENT0 + k);
  for (const target of targets) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32UI, 1024, 1024);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, target, gl.TEXTURE_2D, texture, 0);
  }
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.R32UI, 128, 104);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 128, 104, gl.RED_INTEGER, gl.UNSIGNED_INT, Uint32Array.from(numbers));
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.drawBuffers(targets);
  gl.viewport(0, 0, 1024, 1024);
  gl.useProgram(program);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const words = targets.map(target => {
    const read = new Uint32Array(4 << 20);
    gl.readBuffer(target);
    gl.readPixels(0, 0, 1024, 1024, gl.RGBA_INTEGER, gl.UNSIGNED_INT, read);
    return read;
  });
  return { found: window[what]((k, w) => words[w >> 2][4 * k + (w & 3)]) };
}

async function byWebGPU(text, what, numbers) {
  const adapter = navigator.gpu && await navigator.gpu.requestAdapter();
  if (!adapter) return { missing: "no WebGPU" };
  const device = await adapter.requestDevice();
  const shader = device.createShaderModule({ code: text });
  const { messages } = await shader.getCompilationInfo();
  if (messages.some(m => m.type === "error")) return { wrong: messages.map(m => `${m.lineNum}: ${m.message}`).join("\n") };
  const size = 4 * 16 << 14, usage = GPUBufferUsage;
  const buffer = device.createBuffer({ size, usage: usage.STORAGE | usage.COPY_SRC });
  const pipeline = device.createComputePipeline({ layout: "auto", compute: { module: shader, entryPoint: "main" } });
  const words = new Uint32Array(16 << 20), mask = (1 << 14) - 1;
  const constants = device.createBuffer({ size: 256 * 64, usage: usage.UNIFORM | usage.COPY_DST });
  device.queue.writeBuffer(constants, 0, Uint32Array.from({ length: 64 * 64 }, (_, k) => k % 64 ? 0 : k / 64 << 14));
  const table = device.createBuffer({ size: 4 * numbers.length, usage: usage.STORAGE | usage.COPY_DST });
  device.queue.writeBuffer(table, 0, Uint32Array.from(numbers));
  for (let block = 0; block < 64; block++) {
    const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [
      { binding: 0, resource: { buffer } }, { binding: 1, resource: { buffer: constants, offset: 256 * block, size: 16 } },
      { binding: 2, resource: { buffer: table } }] });
    const read = device.createBuffer({ size, usage: usage.COPY_DST | usage.MAP_READ });
    const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(mask + 1 >> 6);
    pass.end();
    encoder.copyBufferToBuffer(buffer, 0, read, 0, size);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    words.set(new Uint32Array(read.getMappedRange()), 16 * (block << 14));
    read.destroy();
  }
  return { found: window[what]((k, w) => words[16 * k + w]) };
}

// In the page: for each block the hashes of domain, sobol, pmj02, white and keys. word(k, w) is word w of draw k.
function hashesOf(word) {
  const rows = [];
  for (let block = 0; block < 64; block++) {
    const h = [[0, 1], [4, 5, 6, 7], [2, 3], [8, 9, 10, 11], [12, 13, 14, 15]].map(of => {
      let hash = 2166136261;
      for (let k = block << 14; k < block + 1 << 14; k++) for (const w of of) hash = Math.imul(hash ^ word(k, w), 16777619);
      return (hash >>> 0).toString(16).padStart(8, "0");
    });
    rows.push([block, ...h].join(" "));
  }
  return rows;
}

// In the page: the pairs of coordinates, here and in another domain, that are not uniform in 16 x 16 cells, by chi-square of 4,096 draws:
// 255 degrees of freedom, 6 deviations of sqrt(510). The last line is the number of pairs.
function dependentOf(word) {
  const lines = [];
  let pairs = 0;
  for (const [name, of] of Object.entries({ sobol: [4, 5, 6, 7], pmj02: [2, 3], white: [8, 9, 10, 11] })) {
    for (const other of [1, 2, 3]) {
      for (const a of of) for (const b of of) {
        const counts = new Array(256).fill(0);
        for (let k = 0; k < 4096; k++) counts[(word(k, a) >>> 28) * 16 + (word(other << 12 | k, b) >>> 28)]++;
        const squared = counts.reduce((sum, count) => sum + (count - 16) ** 2 / 16, 0);
        if (Math.abs(squared - 255) > 6 * Math.sqrt(510)) lines.push(`${name}, ${["", "uses", "pixels", "frames"][other]}, words ${a} and ${b}: chi-square ${squared}`);
        pairs++;
      }
    }
  }
  return [...lines, `${pairs} pairs`];
}

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader",
    "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"] });
  const page = await browser.newPage();
  await page.route("https://koksma.invalid/", route => route.fulfill({ contentType: "text/html", body: "" })); /* WebGPU asks for https */
  await page.goto("https://koksma.invalid/");
  await page.addScriptTag({ content: hashesOf.toString() + dependentOf });
  const drawn = what => page.evaluate(language === "glsl" ? `(${byWebGL})(${JSON.stringify(fragment(glsl[what]))}, "${what}", [${numbers}])`
    : `(${byWebGPU})(${JSON.stringify(compute(wgsl[what]))}, "${what}", [${numbers}])`);
  const result = await drawn("hashesOf");
  let shown = "", dependent;
  if (result.found) {
    dependent = (await drawn("dependentOf")).found;
    await page.route("https://koksma.invalid/*", route => route.fulfill({
      contentType: "text/html", body: fs.readFileSync(`${ports}/${language}/${new URL(route.request().url()).pathname}`, "utf8") }));
    await page.goto("https://koksma.invalid/example.html");
    await page.waitForSelector("[data-done]", { timeout: 60000 });
    shown = await page.textContent("#result");
  }
  await browser.close();
  if (result.missing) skip(result.missing);
  if (result.wrong) { console.log(result.wrong); process.exit(1); }
  const expected = fs.readFileSync(`${ports}/vectors.txt`, "utf8").split("\n").filter(line => line && line[0] !== "#");
  const different = expected.filter((line, k) => line !== result.found[k]);
  console.log(`${different.length} of ${expected.length} blocks differ${different.length ? ", first: " + different[0] : ""}`);
  if (shown !== fs.readFileSync(`${ports}/example.txt`, "utf8")) { console.log("the example prints " + shown); process.exit(1); }
  if (!dependent || dependent.join() !== "108 pairs") { console.log("two domains: " + (dependent || ["no draws"]).join("\n")); process.exit(1); }
  process.exit(different.length || expected.length !== 64 ? 1 : 0);
})();
