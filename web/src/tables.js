// The figures that need no chart of their own.
import { addChart, axis, grid, legend, tooltip } from './chart.js';
import { card, el, table, tip } from './dom.js';
import { angle, count, figure, length, seconds } from './format.js';
import { color } from './theme.js';
import { words } from './outcomes.js';

const present = (rows) => rows.filter(([, value]) => value !== undefined && value !== null && value !== '–');

const kPhases = [['read_s', 'reading the log', 'sky'], ['prepare_s', 'preparing map and models', 'accent'], ['run_s', 'localizing', 'estimate']];

export function drawTimings({ metrics: { timings } }, parent) {
  if (!timings) return;
  const phases = kPhases.filter(([key]) => Number.isFinite(timings[key]));
  const { element } = card('Timings');
  parent.append(element);
  addChart(element, {
    label: 'Timings',
    height: 126,
    options: () => ({
      grid: grid({ left: 20, top: 36 }),
      legend: { ...legend(), itemHeight: 10, left: 'center' },
      xAxis: axis('time [s]', { min: 0, nameGap: 26 }),
      yAxis: axis('', { type: 'category', data: [''], axisTick: { show: false }, splitLine: { show: false } }),
      tooltip: tooltip({
        axisPointer: { type: 'none' },
        formatter: () => tip('Wall-clock time', phases.map(([key, name, tone]) => [name, seconds(timings[key]), color(tone)])),
      }),
      series: phases.map(([key, name, tone]) => ({
        type: 'bar', stack: 'all', name, barWidth: 18, itemStyle: { color: color(tone) }, data: [timings[key]],
      })),
    }),
  });
  element.append(table(['phase', 'time'], present([
    ...phases.map(([key, name]) => [name, seconds(timings[key])]),
    ['total', seconds(timings.total_s)],
    ['mean of one update', seconds(timings.update_mean_ms / 1000)],
    ['real-time factor (log time / run time)', Number.isFinite(timings.realtime_factor) ? `${figure(timings.realtime_factor)}×` : '–'],
  ])));
}

export function drawAccuracy({ metrics: { accuracy } }, parent) {
  if (!accuracy) return;
  const rows = [
    ['poses compared', count(accuracy.matched)],
    ['mean ± standard deviation', `${length(accuracy.ate_mean_m)} ± ${length(accuracy.ate_std_m)}`],
    ['root mean square', length(accuracy.ate_rmse_m)], ['median', length(accuracy.ate_median_m)],
    ['95th percentile', length(accuracy.ate_p95_m)], ['maximum', length(accuracy.ate_max_m)],
    ['heading, mean', angle(accuracy.heading_mean_rad)], ['heading, maximum', angle(accuracy.heading_max_rad)],
    ['lost', accuracy.lost === undefined ? '–' : accuracy.lost ? 'yes' : 'no'],
  ];
  parent.append(card('Accuracy against the reference', table(['absolute trajectory error', 'value'], present(rows))).element);
}

export function drawLog({ metrics: { log, map } }, parent) {
  if (!log && !map) return;
  const { element } = card('Log and map');
  const facts = present([
    ['log', log?.path], ['format', log?.format], ['span', seconds(log?.span_s)], ['map', map?.path],
    ['map size', map && `${map.width} × ${map.height} cells of ${length(map.resolution_m)}`],
  ]);
  element.append(el('dl', { class: 'facts-list' }, ...facts.flatMap(([name, value]) => [el('dt', {}, name), el('dd', {}, value)])));
  if (log?.streams?.length) {
    element.append(table(['stream', 'kind', 'messages'], log.streams.map((s) => [s.name, words(s.kind ?? ''), count(s.messages)])));
  }
  parent.append(element);
}

export function drawWarnings({ metrics: { warnings } }, parent) {
  const rows = Object.entries(warnings ?? {}).map(([kind, n]) => [kind, count(n)]);
  const body = rows.length > 0 ? table(['warning', 'times'], rows) : el('p', { class: 'sentence' }, 'No warnings.');
  parent.append(card('Warnings', body).element);
}

export function drawConfiguration({ configuration }, parent) {
  parent.append(el('details', {}, el('summary', {}, 'Configuration'), el('pre', {}, configuration)));
}
