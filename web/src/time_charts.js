// Figures over time. All charts zoom together, and show the instant of the timeline as a line.
import { addChart, axis, grid, legend, tooltip, yAxis } from './chart.js';
import { card, el, tip } from './dom.js';
import { count, figure, instant, kDegrees, lengthUnit } from './format.js';
import { largest, nearest, smallest } from './series.js';
import { color } from './theme.js';

// A line: {name, series: {t, v}, factor, unit, color, axis, dashed, area}
function toSeries(line) {
  return {
    type: 'line', name: line.name, yAxisIndex: line.axis ?? 0, showSymbol: false, step: line.step && 'end',
    data: line.series.t.map((t, i) => [t, line.series.v[i] * line.factor]),
    lineStyle: { width: 1.4, color: color(line.color), type: line.dashed ? [5, 3] : 'solid' },
    itemStyle: { color: color(line.color) }, emphasis: { disabled: true },
    areaStyle: line.area && { color: color(line.color), opacity: 0.12 },
    markArea: line.bands && { silent: true, label: { fontSize: 9, color: color('muted') }, data: line.bands() },
  };
}

const withUnit = (value, unit) => (unit === '' ? count(value) : `${figure(value)} ${unit}`);

function valuesAt(lines, t) {
  return lines.map((line) => {
    const i = nearest(line.series.t, t);
    const value = i < 0 ? '–' : withUnit(line.series.v[i] * line.factor, line.unit);
    return [line.name, value, color(line.color)];
  });
}

function optionsOf(lines, axes, timeline) {
  const several = lines.length > 1;
  const right = axes.length > 1 ? 64 : 20;
  return () => ({
    grid: grid({ top: several ? 32 : 12, right }),
    legend: several ? legend() : undefined,
    xAxis: axis('time [s]', { min: timeline.start, max: timeline.end, nameGap: 26, splitLine: { show: false } }),
    yAxis: axes.map((make) => make()),
    dataZoom: [{ type: 'inside', zoomOnMouseWheel: 'ctrl', moveOnMouseWheel: false, filterMode: 'none' }],
    tooltip: tooltip({ formatter: ([first]) => tip(instant(first.axisValue), valuesAt(lines, first.axisValue)) }),
    series: lines.map(toSeries),
  });
}

// The line at the timeline's instant is an element over the canvas: moving it draws no chart again.
function followTimeline({ chart, box }, lines, now, timeline) {
  const cursor = el('div', { class: 'cursor' });
  box.append(cursor);
  const place = () => {
    const x = chart.convertToPixel({ xAxisIndex: 0 }, timeline.now);
    const [{ left, right: rightMargin, top, bottom }] = chart.getOption().grid;
    const right = box.clientWidth - rightMargin + 1;
    Object.assign(cursor.style, { top: `${top}px`, bottom: `${bottom}px` });
    cursor.style.transform = `translateX(${x}px)`;
    cursor.style.visibility = x >= left - 1 && x <= right ? 'visible' : 'hidden';
    now.textContent = valuesAt(lines, timeline.now).map(([, value]) => value).join(' · ');
  };
  timeline.onChange(place);
  chart.on('datazoom', place);
  chart.on('finished', place);
  chart.getZr().on('click', (event) => {
    timeline.set(chart.convertFromPixel({ xAxisIndex: 0 }, event.offsetX));
  });
  chart.getZr().on('dblclick', () => chart.dispatchAction({ type: 'dataZoom', start: 0, end: 100 }));
}

function timeChart(parent, timeline, title, lines, axes) {
  const { element, now } = card(title);
  parent.append(element);
  const placed = addChart(element, { options: optionsOf(lines, axes, timeline), label: title, overTime: true });
  followTimeline(placed, lines, now, timeline);
}

function drawErrors(run, timeline, parent) {
  const s = run.series;
  const unit = lengthUnit(largest(s.position_error_m.v));
  timeChart(parent, timeline, 'Position error', [
    { name: 'error', series: s.position_error_m, factor: unit.factor, unit: unit.name, color: 'error', area: true },
    { name: 'expected by the filter (1σ)', series: s.sigma_position_m, factor: unit.factor, unit: unit.name, color: 'estimate', dashed: true },
  ], [() => yAxis(`position error [${unit.name}]`)]);
  timeChart(parent, timeline, 'Heading error', [
    { name: 'error', series: s.heading_error_rad, factor: kDegrees, unit: '°', color: 'error', area: true },
    { name: 'expected by the filter (1σ)', series: s.sigma_theta_rad, factor: kDegrees, unit: '°', color: 'estimate', dashed: true },
  ], [() => yAxis('heading error [°]')]);
}

function drawSigmas(run, timeline, parent) {
  const s = run.series;
  const unit = lengthUnit(Math.max(largest(s.sigma_x_m.v), largest(s.sigma_y_m.v)));
  timeChart(parent, timeline, 'Uncertainty (1σ of the estimate)', [
    { name: 'σx', series: s.sigma_x_m, factor: unit.factor, unit: unit.name, color: 'estimate' },
    { name: 'σy', series: s.sigma_y_m, factor: unit.factor, unit: unit.name, color: 'reference' },
    { name: 'σ heading (right)', series: s.sigma_theta_rad, factor: kDegrees, unit: '°', color: 'accent', axis: 1 },
  ], [() => yAxis(`σx, σy [${unit.name}]`), () => yAxis('σ heading [°]', { nameGap: 40, splitLine: { show: false } })]);
}

// Global localization starts with a hundred times the particles it needs later: only a log scale shows both.
function drawParticles(run, timeline, parent) {
  const { ess, particles } = run.series;
  const least = Math.max(1, smallest(ess.v));
  const log = particles.v.length > 0 && largest(particles.v) / smallest(particles.v) > 10;
  timeChart(parent, timeline, 'Particles and effective sample size', [
    { name: 'particles', series: particles, factor: 1, unit: '', color: 'estimate', step: true },
    { name: 'effective sample size', series: ess, factor: 1, unit: '', color: 'accent' },
  ], [() => yAxis('particles [count]', log ? { type: 'log', min: 10 ** Math.floor(Math.log10(least)) } : {})]);
}

function drawQuality(run, timeline, parent) {
  timeChart(parent, timeline, 'Quality (share of the scan that the map explains)', [
    { name: 'quality', series: run.series.quality, factor: 100, unit: '%', color: 'reference', area: true },
  ], [() => yAxis('quality [%]', { max: 100, interval: 25 })]);
}

// By the index in TrackingState; tracking is not marked.
const kStates = ['tracking', 'crowded', 'ambiguous', 'lost', 'sensor fault'];
const kStateColors = [undefined, 'particles', 'accent', 'error', 'muted'];

/** Spans of time in one state other than tracking: [from, to, state]. */
export function stateSpans({ t, state }) {
  const spans = [];
  for (let i = 0; i < t.length; ++i) {
    const last = spans[spans.length - 1];
    if (last && last[2] === state[i]) last[1] = t[i];
    else {
      if (last) last[1] = t[i];
      spans.push([t[i], t[i], state[i]]);
    }
  }
  return spans.filter(([, , s]) => s > 0);
}

function drawState(run, timeline, parent) {
  const band = ([from, to, state]) => [
    { name: kStates[state], xAxis: from, itemStyle: { color: color(kStateColors[state]), opacity: 0.25 } }, { xAxis: to }];
  timeChart(parent, timeline, 'State: probability that the pose is right, as the localizer judges it', [
    { name: 'probability', series: run.series.probability, factor: 100, unit: '%', color: 'estimate',
      bands: () => stateSpans(run.belief).map(band) },
  ], [() => yAxis('probability [%]', { min: 0, max: 100, interval: 25 })]);
}

function drawHypotheses(run, timeline, parent) {
  const { hypotheses, weight } = run.series;
  timeChart(parent, timeline, 'Hypotheses', [
    { name: 'hypotheses', series: hypotheses, factor: 1, unit: '', color: 'particles', step: true },
    { name: 'weight of the heaviest (right)', series: weight, factor: 100, unit: '%', color: 'reference', axis: 1 },
  ], [() => yAxis('hypotheses [count]', { minInterval: 1, max: ({ max }) => Math.max(3, max) }),
    () => yAxis('weight [%]', { max: 100, interval: 25, nameGap: 40, splitLine: { show: false } })]);
}

export function drawTimeCharts(run, timeline, parent) {
  if (run.series.position_error_m) drawErrors(run, timeline, parent);
  if (run.series.sigma_x_m.v.length > 0) {
    drawSigmas(run, timeline, parent);
    drawParticles(run, timeline, parent);
    drawState(run, timeline, parent);
    drawQuality(run, timeline, parent);
    drawHypotheses(run, timeline, parent);
  }
}
