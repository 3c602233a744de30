// Builds the report from the JSON blob that cairn/eval/report.cpp puts into the page (its header lists the fields).
import { byId, el } from './dom.js';
import { Timeline } from './timeline.js';
import { drawHeader, drawTiles } from './headline.js';
import { drawMapCard } from './map_card.js';
import { drawTimeCharts } from './time_charts.js';
import { drawHistograms } from './histogram.js';
import { drawOutcomes } from './outcomes.js';
import { drawAccuracy, drawConfiguration, drawLog, drawTimings, drawWarnings } from './tables.js';
import { onThemeChange } from './theme.js';

function drawAll(run) {
  const timeline = new Timeline(run.path.t);
  drawHeader(run);
  drawTiles(run, byId('tiles'));
  drawMapCard(run, timeline, byId('map-card'));
  drawTimeCharts(run, timeline, byId('charts'));
  drawHistograms(run, byId('charts'));
  const tables = byId('tables');
  drawOutcomes(run, tables);
  drawTimings(run, tables);
  drawAccuracy(run, tables);
  drawLog(run, tables);
  drawWarnings(run, tables);
  drawConfiguration(run, byId('configuration'));
  byId('footer').append(`Made by Cairn ${run.metrics.cairn_version}. One file, nothing is loaded from the network.`);
  timeline.set(timeline.end);
  return timeline;
}

function main() {
  try {
    const run = JSON.parse(byId('run').textContent);
    drawAll(run);
    onThemeChange.notifyOnChange();
    document.documentElement.dataset.ready = 'yes';
  } catch (error) {
    byId('headline').append(el('p', { class: 'problem' }, `This report cannot be shown: ${error.message}`));
    throw error;
  }
}

main();
