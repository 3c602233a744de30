// Makes a page: bundles its script with the parts of ECharts that it uses, and puts script and style into its
// template. Writes the page, and the same page as a C++ source for the program.
// usage: node build.mjs report|campaign PAGE.html [PAGE.cpp]
import { build } from 'esbuild';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const read = (...parts) => readFileSync(join(here, ...parts), 'utf8');

// The licences ask that their notices travel with the code; the minifier would drop them.
function notices() {
  const echarts = read('node_modules', 'echarts', 'NOTICE').trim();
  const zrender = read('node_modules', 'zrender', 'LICENSE').trim();
  const apache = 'Licensed under the Apache License, Version 2.0: http://www.apache.org/licenses/LICENSE-2.0';
  return `/*!\nThis page contains:\n\n${echarts}\n${apache}\n\nZRender\n${zrender}\n*/`;
}

async function bundle(entry, options = {}) {
  const result = await build({
    entryPoints: [join(here, 'src', entry)],
    bundle: true,
    minify: true,
    write: false,
    target: 'es2020',
    legalComments: 'none',
    charset: 'ascii',
    ...options,
  });
  return result.outputFiles[0].text.trim();
}

// "</script" inside a script would end it; the escape means the same inside a string or a regular expression.
const inScript = (code) => code.replaceAll('</script', '<\\/script');

function fill(template, parts) {
  return Object.entries(parts).reduce((page, [name, text]) => {
    const mark = `<!--CAIRN:${name}-->`;
    if (page.split(mark).length !== 2) throw new Error(`the template must hold ${mark} once`);
    return page.replace(mark, () => text);
  }, template);
}

// Compilers limit the length of one literal, so the page goes in pieces; a delimiter that occurs nowhere in it.
function toCpp(name, page) {
  const pieces = [];
  for (let i = 0; i < page.length; i += 8000) pieces.push(`    R"CAIRNPAGE(${page.slice(i, i + 8000)})CAIRNPAGE"sv,`);
  return `// Made by web/build.mjs.
#include "web/report_page.hpp"

namespace cairn::web {
using namespace std::string_view_literals;

static constexpr std::string_view kPieces[] = {
${pieces.join('\n')}
};

std::string ${name}_page() {
  std::string page;
  for (const std::string_view piece : kPieces) page += piece;
  return page;
}

${name === 'report' ? 'std::string why_no_report_page() { return {}; }\n' : ''}
}  // namespace cairn::web
`;
}

// Script and template of each page.
const kPages = { report: ['main.js', 'report.html'], campaign: ['campaign.js', 'campaign.html'] };

const [name, pageFile, cppFile] = process.argv.slice(2);
const [entry, template] = kPages[name];
const script = inScript(await bundle(entry, { format: 'iife' }));
const style = await bundle('report.css');
const page = fill(read('src', template), {
  STYLE: `<style>${style}</style>`,
  SCRIPT: `<script>${notices()}\n${script}</script>`,
});
for (const [file, text] of [[pageFile, page], [cppFile, toCpp(name, page)]]) {
  if (!file) continue;
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
}
