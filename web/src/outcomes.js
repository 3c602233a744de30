// What became of the messages of each stream: every message ends in exactly one outcome.
import { addChart, axis, grid, legend, tooltip } from './chart.js';
import { card, table, tip } from './dom.js';
import { count, percent } from './format.js';
import { color } from './theme.js';

// The uses, not needed, then the reasons for dropping.
const kOrder = ['used', 'replayed', 'deferred', 'not_needed', 'pending'];
const kColors = ['estimate', 'accent', 'purple', 'sky', 'grey', 'error', 'yellow'];
const kDropColors = kColors.slice(5);

export const words = (name) => name.replaceAll('_', ' ');

function namesOf(outcomes) {
  const seen = new Set(Object.values(outcomes).flatMap((stream) => Object.keys(stream).filter((name) => stream[name] > 0)));
  const drops = [...seen].filter((name) => !kOrder.includes(name)).sort();
  return [...kOrder.filter((name) => seen.has(name)), ...drops];
}

function colorOf(name, names) {
  const place = kOrder.indexOf(name);
  const drop = names.filter((other) => !kOrder.includes(other)).indexOf(name);
  return color(place >= 0 ? kColors[place] : kDropColors[drop % kDropColors.length]);
}

export function drawOutcomes({ metrics }, parent) {
  const outcomes = metrics.outcomes ?? {};
  const streams = Object.keys(outcomes);
  if (streams.length === 0) return;
  const names = namesOf(outcomes);
  const total = (stream) => Object.values(outcomes[stream]).reduce((a, b) => a + b, 0);
  const { element } = card('Outcomes per stream');
  element.classList.add('wide');
  parent.append(element);
  addChart(element, {
    label: 'Outcomes per stream',
    height: 92 + 34 * streams.length,
    options: () => ({
      grid: grid({ left: 152, top: 36 }),
      legend: { ...legend(), data: names.map(words), itemHeight: 10, left: 'center', type: 'plain' },
      xAxis: axis('share of the messages [%]', { min: 0, max: 100, nameGap: 26 }),
      yAxis: axis('', { type: 'category', data: streams, inverse: true, axisLabel: { color: color('text'), width: 136, overflow: 'truncate' }, splitLine: { show: false } }),
      tooltip: tooltip({
        axisPointer: { type: 'none' },
        formatter: ([bar]) => tip(streams[bar.dataIndex], names.map((name) =>
          [words(name), count(outcomes[streams[bar.dataIndex]][name] ?? 0), colorOf(name, names)])),
      }),
      series: names.map((name) => ({
        type: 'bar', stack: 'all', name: words(name), barWidth: 18, itemStyle: { color: colorOf(name, names) },
        data: streams.map((stream) => 100 * (outcomes[stream][name] ?? 0) / Math.max(1, total(stream))),
      })),
    }),
  });
  const dropped = (stream) => names.filter((name) => name.startsWith('dropped_'))
    .reduce((sum, name) => sum + (outcomes[stream][name] ?? 0), 0);
  element.append(table(['stream', ...names.map(words), 'messages', 'drop rate'], streams.map((stream) =>
    [stream, ...names.map((name) => cellOf(outcomes[stream][name] ?? 0, total(stream))), count(total(stream)),
      percent(dropped(stream) / Math.max(1, total(stream)))])));
}

const cellOf = (n, all) => (n === 0 ? '0' : `${count(n)} (${percent(n / all)})`);
