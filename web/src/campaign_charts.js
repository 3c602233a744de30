// The charts of a campaign. Each shows what `choice` names and redraws itself when that changes.
import { use } from 'echarts/core';
import { CustomChart, ScatterChart } from 'echarts/charts';
import { addChart, axis, grid, legend, tooltip, yAxis } from './chart.js';
import { card, el } from './dom.js';
import { shown } from './campaign_tables.js';
import { color, scaleColor } from './theme.js';

use([CustomChart, ScatterChart]);

const kTones = ['estimate', 'error', 'reference', 'particles', 'accent', 'sky', 'purple', 'grey', 'yellow'];
const kLost_m = 1;
const kTimeSteps = 120;

const variantsOf = (data) => [...new Set(data.results.map((result) => result.variant))];
const tone = (data, variant) => color(kTones[variantsOf(data).indexOf(variant) % kTones.length]);

function addCard(parent, title, more) {
  const { element } = card(title);
  parent.append(element);
  return addChart(element, { label: title, height: 300, ...more });
}

// Mean and interval as a dot on a whisker, one column per variant.
function whisker(tones) {
  return (params, api) => {
    const [x, low] = api.coord([api.value(0), api.value(2)]);
    const [, high] = api.coord([api.value(0), api.value(3)]);
    const [, mean] = api.coord([api.value(0), api.value(1)]);
    const stroke = tones[params.dataIndex];
    return {
      type: 'group',
      children: [
        { type: 'line', shape: { x1: x, y1: low, x2: x, y2: high }, style: { stroke, lineWidth: 2.5 } },
        { type: 'circle', shape: { cx: x, cy: mean, r: 5 }, style: { fill: stroke } },
      ],
    };
  };
}

export function drawIntervals(data, choice, parent) {
  addCard(parent, 'Mean with 95 % interval', {
    options: () => {
      const style = data.styles[choice.metric];
      const groups = data.groups.filter((g) => g.input === choice.input && g.metrics[choice.metric]);
      const points = groups.map(({ metrics: { [choice.metric]: m } }, i) =>
        [i, m.mean, m.low ?? m.mean, m.high ?? m.mean].map((value, k) => (k === 0 ? value : value * style.factor)));
      return {
        grid: grid({ left: 74 }),
        xAxis: axis('', { type: 'category', data: groups.map((g) => g.variant), axisLabel: { color: color('text'), interval: 0 } }),
        yAxis: yAxis(style.label, { nameGap: 54 }),
        tooltip: tooltip({ trigger: 'item', formatter: ({ dataIndex: i }) => el('div', {}, `${groups[i].variant}: ${shown(style, groups[i].metrics[choice.metric].mean)} ${style.unit}`) }),
        series: [{ type: 'custom', data: points, encode: { x: 0, y: [1, 2, 3] }, renderItem: whisker(groups.map((g) => tone(data, g.variant))) }],
      };
    },
  });
}

const tracesOf = (data, choice, variant) =>
  data.traces.filter((trace, i) => data.results[i].input === choice.input && data.results[i].variant === variant && trace.t.length > 0);

// Error over the map, as in Biswas & Veloso, Fig. 2: every judged pose of every run, coloured by its error.
export function drawErrorMap(data, choice, parent) {
  addCard(parent, 'Error over the map (dark: small, bright: 0.5 m and more)', {
    options: () => {
      const points = variantsOf(data).flatMap((variant) => tracesOf(data, choice, variant)).flatMap(({ x, y, e }) =>
        x.map((value, i) => ({ value: [value, y[i]], e: e[i] })));
      points.sort((a, b) => a.e - b.e);
      return {
        grid: grid(),
        xAxis: axis('x [m]', { scale: true, nameGap: 26 }),
        yAxis: axis('y [m]', { scale: true, nameGap: 40 }),
        series: [{
          type: 'scatter', symbolSize: 3, silent: true,
          data: points.map(({ value, e }) => ({ value, itemStyle: { color: scaleColor(Math.min(1, e / 0.5)) } })),
        }],
      };
    },
  });
}

function atTime(trace, t) {
  let i = trace.t.findIndex((time) => time > t);
  if (i < 0) i = trace.t.length;
  return trace.e[Math.max(0, i - 1)];
}

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

// One curve per variant of `value(errors of all runs at that time)`.
function drawOverTime(data, choice, parent, title, yOptions, value) {
  addCard(parent, title, {
    options: () => {
      const runs = variantsOf(data).map((variant) => [variant, tracesOf(data, choice, variant)]).filter(([, all]) => all.length > 0);
      const end = Math.max(1, ...runs.flatMap(([, all]) => all.map((trace) => trace.t.at(-1))));
      const times = Array.from({ length: kTimeSteps + 1 }, (_, i) => (i * end) / kTimeSteps);
      return {
        grid: grid({ top: 30 }),
        legend: legend(),
        tooltip: tooltip({ valueFormatter: (y) => y.toFixed(3) }),
        xAxis: axis('time [s]', { min: 0, max: end, nameGap: 26 }),
        yAxis: yOptions(),
        series: runs.map(([variant, all]) => ({
          type: 'line', name: variant, showSymbol: false, color: tone(data, variant),
          data: times.map((t) => [t, value(all.map((trace) => atTime(trace, t)))]),
        })),
      };
    },
  });
}

export function drawConvergence(data, choice, parent) {
  const floor = 0.001;
  drawOverTime(data, choice, parent, 'Convergence: median error over time', () => axis('error [m]', { type: 'log', nameGap: 46 }),
    (errors) => Math.max(floor, median(errors)));
}

export function drawSurvival(data, choice, parent) {
  drawOverTime(data, choice, parent, 'Survival: runs within 1 m of the truth', () => yAxis('share of runs', { max: 1 }),
    (errors) => errors.filter((e) => e < kLost_m).length / errors.length);
}

export function drawDistribution(data, choice, parent) {
  addCard(parent, 'Distribution of the error', {
    options: () => ({
      grid: grid({ top: 30 }),
      legend: legend(),
      tooltip: tooltip({ valueFormatter: (y) => `${(100 * y).toFixed(1)} %` }),
      xAxis: axis('error [m]', { type: 'log', min: 0.001, nameGap: 26 }),
      yAxis: yAxis('share below', { max: 1 }),
      series: variantsOf(data).map((variant) => {
        const all = tracesOf(data, choice, variant).flatMap((trace) => trace.e).sort((a, b) => a - b);
        const step = Math.max(1, Math.floor(all.length / 300));
        const points = all.map((e, i) => [Math.max(0.001, e), (i + 1) / all.length]).filter((_, i) => i % step === 0 || i === all.length - 1);
        return { type: 'line', name: variant, showSymbol: false, color: tone(data, variant), data: points };
      }),
    }),
  });
}
