// Builds the page of a campaign from the JSON blob that cairn/eval/campaign_tables.cpp puts into it.
import { byId, el } from './dom.js';
import { drawCells, drawComparisons, drawGroups } from './campaign_tables.js';
import { drawConvergence, drawDistribution, drawErrorMap, drawIntervals, drawSurvival } from './campaign_charts.js';
import { onThemeChange } from './theme.js';

function drawHeader({ title, about, finished, cells }) {
  document.title = title;
  const done = el('span', { class: `badge ${finished === cells ? 'good' : 'warn'}` }, `${finished} of ${cells} runs`);
  byId('headline').append(el('div', { class: 'brand' }, 'Cairn campaign'), el('h1', {}, title), el('p', { class: 'facts' }, about));
  byId('verdict').append(done);
}

function select(label, names, change) {
  const options = names.map((name) => el('option', { value: name }, name));
  return el('label', {}, label, el('select', { onchange: (event) => change(event.target.value) }, ...options));
}

// Pictures that were drawn by the command (cairn/eval/campaign_figures.cpp).
function drawFigures({ figures = [] }, parent) {
  parent.hidden = figures.length === 0;
  for (const svg of figures) {
    const image = el('img', { alt: 'Distributions of the errors, real and simulated' });
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
    image.style.maxWidth = '100%';
    parent.append(image);
  }
}

// Which metric and which input the charts show; every chart redraws itself from it.
function makeChoices(data) {
  const inputs = [...new Set(data.results.map((result) => result.input))];
  const metrics = [...data.columns, ...Object.keys(data.styles).filter((name) => !data.columns.includes(name))];
  const choice = { metric: metrics.includes('ate_mean_m') ? 'ate_mean_m' : metrics[0], input: inputs[0] };
  const choose = (key) => (value) => {
    choice[key] = value;
    onThemeChange.notify();
  };
  byId('choices').append(select('Metric', metrics, choose('metric')), select('Input', inputs, choose('input')));
  byId('choices').querySelector('select').value = choice.metric;
  return choice;
}

function main() {
  try {
    const data = JSON.parse(byId('run').textContent);
    drawHeader(data);
    drawGroups(data, byId('groups'));
    drawComparisons(data, byId('comparisons'));
    const choice = makeChoices(data);
    const charts = byId('charts');
    const ofTraces = data.traces.some((trace) => trace.t.length > 0) ? [drawErrorMap, drawConvergence, drawSurvival, drawDistribution] : [];
    for (const draw of [drawIntervals, ...ofTraces]) draw(data, choice, charts);
    drawFigures(data, byId('figures'));
    drawCells(data, byId('cells'));
    onThemeChange.notifyOnChange();
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    byId('headline').append(el('p', { class: 'problem' }, `This page cannot be shown: ${error.message}`));
    throw error;
  }
}

main();
